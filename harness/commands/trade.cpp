// touchstone advise --front: measures speed against accuracy on one scene.
#include "harness/commands/trade.h"
#include "harness/commands/arguments.h"
#include "harness/commands/pictures/figures.h"
#include "harness/commands/shared_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/cells/motion/motion_front.h"
#include "harness/commands/commands.h"
#include "harness/stats/cells/cell_tables.h"
#include "harness/trade/trade_files.h"

namespace touchstone::commands {
namespace {

void draw(const std::filesystem::path& folder) {
  const std::filesystem::path log = folder / "figure.txt";
  switch (draw_figures("trade.py", {folder.string(), "--out", folder.string()}, log)) {
    case Drawing::drawn: fmt::print("{} and .svg, .pdf\n", (folder / "trade.png").string()); return;
    case Drawing::failed:
      throw base::InputError(
          fmt::format("the figure could not be drawn; {} says why", log.string()));
    case Drawing::no_matplotlib:
      fmt::print(stderr,
                 "touchstone: without matplotlib (Debian: python3-matplotlib) there is no figure; "
                 "`touchstone show {} --figures` installs it and draws\n",
                 folder.string());
  }
}

// Measures discrete steps against continuous ones.
int run_motion_trade(const FrontOptions& options) {
  const trade::TradeRequest& asked = options.request;
  if (asked.task != Task::intersect || !options.error.empty()) {
    throw base::InputError(
        "--motion asks which pairs touch in a step, and its error is the share of hits missed; "
        "expected neither --task nor --error with it");
  }
  if (asked.executor != ExecutorKind::crew) {
    throw base::InputError("--motion runs its steps on the crew; expected no --executor with it");
  }
  if (!options.out.empty()) record::expect_writable(options.out);
  const cells::MotionTrade trade = cells::plan_motion_trade(
      cells::default_motion_trade(options.scene, asked.overrides, asked.threads), asked.seconds);
  const std::filesystem::path folder = trade_folder(options.out, trade.cells.name + "-motion");
  const cells::CellRunResult result =
      cells::run_cells(trade.cells, folder, record::FolderStart::overwrite,
                       [](const std::string& line) { fmt::print(stderr, "{}\n", line); });
  if (result.interrupted) return end_interrupted();
  stats::write_cell_tables(folder, trade.cells.name, folder);
  print_summary(folder, fmt::format("{}\n{}: points.csv, front.csv, front.md, tables.md, raw.csv\n",
                                    cells::write_motion_front(trade, folder), folder.string()));
  if (!options.plain) draw(folder);
  return result.ours_wrong ? exit_measured_wrong : exit_done;
}

}  // namespace

std::filesystem::path trade_folder(const std::string& out, const std::string& name) {
  return results_folder(out, name, "trade-");
}

int run_trade(trade::TradeRequest request, const std::filesystem::path& folder, bool with_figure) {
  record::expect_writable(folder);
  trade::TradeScene scene(request, representing());
  files::expect_other_files(scene.scene.inputs(),
                            std::vector<files::NamedFile>{{"--out", folder / "trade.toml"}});
  if (request.name.empty()) request.name = scene.scene.name;
  const trade::TradeResult result = trade::measure_trade(
      request, scene, folder, [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
  print_summary(
      folder,
      fmt::format(
          "{}\n{}: points.csv, bins.csv, front.md, samples.csv; trade.toml measures it again\n",
          trade::front_text(result, request, base::page_width()), folder.string()));
  if (with_figure) draw(folder);
  return exit_done;
}

void add_trade_axes(Arguments& command, trade::TradeRequest& request) {
  command.one_of("--task", request.task, trade_task_choices(), "What is asked");
  add_threads(command, request.threads);
  command.one_of("--executor", request.executor, executor_choices(),
                 "Whose threads: ours (crew, the default) or oneTBB's");
  command.number("--frames", request.overrides.frames, "Frames").positive();
  add_scene_overrides(command, request.overrides);
  command.number("--seconds", request.seconds, "For all of it, about").positive().show_default();
}

void add_error_measure(Arguments& command, std::string& name) {
  command.text("--error", name, "What counts as the error of a configuration")
      .among({trade::error_measure_names.begin(), trade::error_measure_names.end()});
}

void take_measure(const std::string& name, trade::TradeRequest& request) {
  request.measure = trade::default_measure(request.task);
  const auto at = std::ranges::find(trade::error_measure_names, name);
  if (at != trade::error_measure_names.end()) {
    request.measure = static_cast<trade::ErrorMeasure>(at - trade::error_measure_names.begin());
  }
}

int run_front(const FrontOptions& options) {
  if (options.motion) return run_motion_trade(options);
  trade::TradeRequest request = options.request;
  request.scene = options.scene;
  request.name = request.scene.stem().string();
  take_measure(options.error, request);
  return run_trade(request, trade_folder(options.out, request.name), !options.plain);
}

}  // namespace touchstone::commands
