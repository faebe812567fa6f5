// touchstone trade: speed against accuracy on one scene.
#include "harness/commands/trade.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/base/error.h"
#include "harness/base/text_table.h"
#include "harness/commands/checks.h"
#include "harness/commands/commands.h"
#include "harness/process/subprocess.h"
#include "harness/record/build_info.h"
#include "harness/trade/trade_files.h"

namespace touchstone {
namespace {

struct Options {
  TradeRequest request;
  std::string scene, out, error;
  bool plain = false;
};

// Draws the figure with the first Python that has matplotlib.
void draw(const std::filesystem::path& folder) {
  for (const std::string python : {"/usr/bin/python3", "python3"}) {
    const std::filesystem::path log = folder / "figure.txt";
    int status = 1;
    try {
      status = run_and_wait(python, {"-c", "import matplotlib"}, log);
      if (status == 0) {
        status =
            run_and_wait(python,
                         {"-B", (std::filesystem::path(source_folder) / "plots/trade.py").string(),
                          folder.string(), "--out", folder.string()},
                         log);
        if (status != 0) {
          throw InputError(fmt::format("the figure could not be drawn; {} says why", log.string()));
        }
        std::filesystem::remove(log);
        fmt::print("{} and .svg, .pdf\n", (folder / "trade.png").string());
        return;
      }
    } catch (const InputError&) {
      if (status == 0) throw;
    }
    std::filesystem::remove(log);
  }
  fmt::print(stderr,
             "touchstone: without matplotlib (Debian: python3-matplotlib) there is no figure; "
             "`touchstone plot {}` installs it and draws\n",
             folder.string());
}

}  // namespace

std::filesystem::path trade_folder(const std::string& out, const std::string& name) {
  return out.empty() ? std::filesystem::path(source_folder) / "results/local" / ("trade-" + name)
                     : std::filesystem::path(out);
}

int run_trade(TradeRequest request, const std::filesystem::path& folder, bool with_figure) {
  TradeScene scene(request, representing());
  if (request.name.empty()) request.name = scene.scene.name;
  std::filesystem::create_directories(folder);
  const TradeResult result = measure_trade(
      request, scene, folder, [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
  write_trade(result, request, scene, folder);
  fmt::print("{}\n", front_text(result, request, page_width()));
  fmt::print("{}: points.csv, bins.csv, front.md, raw.csv; trade.toml measures it again\n",
             folder.string());
  if (with_figure) draw(folder);
  return exit_done;
}

void add_trade_axes(CLI::App& command, TradeRequest& request) {
  command
      .add_option_function<std::string>(
          "--task",
          [&request](const std::string& name) {
            for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
              if (name == to_string(task)) request.task = task;
            }
          },
          "intersect, distance, penetration")
      ->check(CLI::IsMember({"intersect", "distance", "penetration"}));
  command.add_option("--threads", request.threads, "Threads")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("--frames", request.overrides.frames, "Frames")->check(CLI::PositiveNumber);
  command.add_option("--count", request.overrides.count, "Bodies of a generated scene")
      ->check(CLI::PositiveNumber);
  command.add_option("--seed", request.overrides.seed, "Seed of a generated scene")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--seconds", request.seconds, "For all of it, about")
      ->check(positive_number)
      ->capture_default_str();
}

void take_measure(const std::string& name, TradeRequest& request) {
  request.measure = default_measure(request.task);
  const auto at = std::ranges::find(error_measure_names, name);
  if (at != error_measure_names.end()) {
    request.measure = static_cast<ErrorMeasure>(at - error_measure_names.begin());
  }
}

void add_trade(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "trade", "Speed against accuracy on a scene: every configuration, and the Pareto front");
  command->add_option("scene", options->scene, "Scene file: .toml or rigid-ipc's .json")
      ->required();
  command->add_option(
      "--out", options->out,
      "Folder for rows, front and figure (default: results/local/trade-NAME in the project)");
  command->add_option("--error", options->error, "What counts as the error of a configuration")
      ->check(CLI::IsMember(
          std::vector<std::string>(error_measure_names.begin(), error_measure_names.end())));
  command->add_flag("--no-figure", options->plain, "Leave the figure out");
  add_trade_axes(*command, options->request);
  command->callback([options, &status] {
    TradeRequest& request = options->request;
    request.scene = options->scene;
    request.name = request.scene.stem().string();
    take_measure(options->error, request);
    status = run_trade(request, trade_folder(options->out, request.name), !options->plain);
  });
}

}  // namespace touchstone
