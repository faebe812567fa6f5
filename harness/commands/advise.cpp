// touchstone advise: finds the cheapest configuration whose error on a scene is within a budget, or
// with --front those that no other beats.
#include "harness/commands/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/cells/motion.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/pictures.h"
#include "harness/commands/shared_options.h"
#include "harness/modules/modules.h"
#include "harness/stats/cell_tables.h"
#include "harness/trade/advice/advice_files.h"
#include "harness/trade/trade_files.h"

namespace touchstone::commands {
namespace {

struct AdviseOptions {
  trade::TradeRequest request;
  trade::ErrorBudget budget;
  std::string scene, list, out, error, with;
  bool verify = false, front = false, motion = false, plain = false;
  int draws = 3;
};

void say(const std::string& text) { fmt::print(stderr, "{}\n", text); }

// Advises on one scene. Returns the exit status, and adds what it prints to `said`.
int advise(const trade::AdviceTask& task, const std::filesystem::path& folder, int draws,
           trade::VerificationRows* rows, std::string& said) {
  const trade::Representing ours = representing();
  trade::TradeScene scene(task.request, ours);
  files::expect_other_files(scene.scene.inputs(),
                            std::vector<files::NamedFile>{{"--out", folder / "advice.toml"}});
  std::filesystem::create_directories(folder);
  const trade::AdviceProblem problem{task.request, scene, ours, task.budget, say};
  const trade::Advice advice = trade::advise(problem);
  trade::write_advice(advice, problem, folder);
  const auto print = [&](const std::string& text) {
    fmt::print("{}", text);
    said += text;
  };
  print(trade::advice_text(advice, problem));
  if (!advice.best) {
    if (rows != nullptr) rows->write(problem, nullptr);
    return exit_measured_wrong;
  }
  print(
      fmt::format("\n{}: `touchstone run` measures it again\n", (folder / "advice.toml").string()));
  if (rows == nullptr) return exit_done;
  const trade::Verification verification = trade::verify(
      problem, advice.best->point.configuration, trade::verification_draw, draws, folder / "grid");
  rows->write(problem, &verification);
  print("\n" + trade::verification_text(verification));
  return verification.holds() ? exit_done : exit_measured_wrong;
}

int advise(AdviseOptions& options) {
  std::vector<trade::AdviceTask> tasks;
  std::filesystem::path folder;
  if (!options.list.empty()) {
    tasks = trade::read_advice_list(options.list, options.request);
    folder = results_folder(options.out, "advice");
  } else {
    trade::AdviceTask& task = tasks.emplace_back();
    task.request = options.request;
    task.request.scene = options.scene;
    task.name = task.request.scene.stem().string();
    task.request.name = task.name + "-advice";
    take_measure(options.error, task.request);
    task.budget = options.budget;
    folder = trade_folder(options.out, task.request.name);
  }
  // A file that is no scene, or a disk that is not for writing, is reported before hours of work.
  record::expect_writable(folder);
  for (const trade::AdviceTask& task : tasks) trade::TradeScene(task.request, representing());
  std::filesystem::create_directories(folder);
  std::optional<trade::VerificationRows> rows;
  if (options.verify) rows.emplace(folder, options.draws);
  int status = exit_done;
  std::string said;
  for (const trade::AdviceTask& task : tasks) {
    const int found = advise(task, options.list.empty() ? folder : folder / task.name,
                             options.draws, rows ? &*rows : nullptr, said);
    if (found != exit_done) status = found;
    if (tasks.size() > 1) fmt::print("\n");
    if (tasks.size() > 1) said += "\n";
  }
  keep_summary(folder, said);
  if (rows) {
    rows->close();
    fmt::print("\n{}: a row for each scene\n", (folder / "verification.csv").string());
  }
  return status;
}

int run_front(const AdviseOptions& options) {
  return run_front(FrontOptions{.request = options.request,
                                .scene = options.scene,
                                .out = options.out,
                                .error = options.error,
                                .plain = options.plain,
                                .motion = options.motion});
}

}  // namespace

void add_advise(Arguments command) {
  auto options = std::make_shared<AdviseOptions>();
  const Option scene =
      command.text("scene", options->scene, "Scene file: .toml or rigid-ipc's .json").is_read();
  Option list =
      command.text("--list", options->list, "File of scenes, each with its own error").is_read();
  command
      .number("--max-error", options->budget.most,
              "The greatest error that will do, as tests have to show at 95 %")
      .not_negative()
      .show_default();
  command.flag("--no-false-negatives", options->budget.no_false_negatives,
               "No contact may be missed, or be left without an answer");
  add_error_measure(command, options->error);
  const Option verify =
      command.flag("--verify", options->verify,
                   "Hold the advice against the full grid, and against scenes that were not "
                   "looked at");
  command.number("--seeds", options->draws, "How many such scenes")
      .within(1, 100)
      .needs(verify)
      .show_default();
  Option front =
      command.flag("--front", options->front,
                   "Measure every configuration instead, and draw those that no other beats in "
                   "both time and error: the Pareto front");
  command.flag("--no-figure", options->plain, "Leave the figure of the front out").needs(front);
  command
      .flag("--motion", options->motion,
            "Compare substeps of narrow phases with casts, on bodies that move within a frame")
      .needs(front);
  command.text("--out", options->out,
               "Folder (default: results/local/trade-NAME-advice; with --front "
               "trade-NAME)");
  add_trade_axes(command, options->request);
  command
      .text("--with", options->with,
            "Also try the broad phases, narrow phases and mesh algorithms of these modules, joined "
            "by "
            "commas: ./libmine.so")
      .excludes(command.option("--motion"));
  list.excludes(scene);
  for (const char* name :
       {"--max-error", "--no-false-negatives", "--error", "--task", "--count", "--seed"}) {
    list.excludes(command.option(name));
  }
  front.excludes(list);
  for (const char* name : {"--max-error", "--no-false-negatives", "--verify", "--seeds"}) {
    front.excludes(command.option(name));
  }
  command.job([options, scene, list] {
    if (!scene.given() && !list.given()) {
      throw base::InputError("advise: no scene; expected a scene file, or --list FILE");
    }
    expect_module_files(options->with);
    modules::load_named(options->with);
    return options->front ? run_front(*options) : advise(*options);
  });
}

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
