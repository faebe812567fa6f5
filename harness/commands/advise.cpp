// touchstone advise: the cheapest configuration that is right enough for a scene.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "harness/commands/commands.h"
#include "harness/commands/trade.h"
#include "harness/run/build_info.h"
#include "harness/stats/markdown.h"
#include "harness/trade/advise.h"

namespace touchstone {
namespace {

struct Options {
  TradeRequest request;
  ErrorBudget budget;
  std::string scene, out, error;
};

std::string interval(const TimedPoint& timed) {
  if (std::isnan(timed.low)) return "";
  return fmt::format(" ({:.4g} to {:.4g})", timed.low * 1e3, timed.high * 1e3);
}

std::string describe(const TradeOutcome& outcome, ErrorMeasure measure) {
  const Configuration& c = outcome.point.configuration;
  const PointErrors& errors = outcome.evaluation.errors;
  const PipelineCounters& work = outcome.evaluation.counters;
  std::string text = fmt::format("  bodies as      {}\n", c.representations.name());
  if (c.broad != nullptr) {
    text += fmt::format("  boxes          {}\n  broad phase    {}\n", c.boxes.name(),
                        c.broad->info.name);
  }
  text += fmt::format("  narrow phase   {}\n", c.narrow_name());
  text += fmt::format("  costs          {:.4g} ms a frame{}, and {:.3g} s beforehand\n",
                      outcome.timed.seconds * 1e3, interval(outcome.timed), outcome.preparation);
  text += fmt::format(
      "  error          {:.3g} ({}): of {} pairs near each other {} false contacts, {} missed, {} "
      "without an answer\n",
      outcome.error, to_string(measure), errors.near, errors.false_positives + errors.far,
      errors.false_negatives, errors.failed);
  text += fmt::format(
      "  needs          {} hulls built, {} shapes bound; for the frames looked at {} updates, {} "
      "queries, "
      "{} witness points\n",
      work.hulls_built, work.shapes_bound, work.updates, work.queries, work.witnesses);
  return text;
}

int advise(Options& options) {
  TradeRequest& request = options.request;
  request.scene = options.scene;
  request.name = request.scene.stem().string() + "-advice";
  take_measure(options.error, request);
  const Representing ours = representing();
  TradeScene scene(request, ours);
  const std::filesystem::path folder = trade_folder(options.out, request.name);
  std::filesystem::create_directories(folder);
  const Advice advice =
      touchstone::advise(request, scene, ours, options.budget,
                         [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
  const std::string budget =
      fmt::format("{} at most {}{}", to_string(request.measure), options.budget.most,
                  options.budget.no_false_negatives ? ", no contact missed" : "");
  std::string text =
      fmt::format("{}: {}; {} configurations, {} within the budget, {} timed\n\n", scene.scene.name,
                  budget, advice.configurations, advice.within_budget, advice.timed);
  if (!advice.best) {
    fmt::print("{}Nothing that was tried meets the budget.\n", text);
    return exit_measured_wrong;
  }
  text += fmt::format("Cheapest: {}\n{}", advice.best->point.configuration.name(),
                      describe(*advice.best, request.measure));
  text += fmt::format(
      "  elsewhere      {:.3g} on {}: {} pairs, {} missed\n\n",
      error_of(advice.held_out.errors, advice.best->representation, request.measure),
      advice.held_out_on, advice.held_out.errors.near, advice.held_out.errors.false_negatives);
  if (advice.next_better) {
    text += fmt::format("Next better: {}, for {:.3g} times the time\n{}",
                        advice.next_better->point.configuration.name(),
                        advice.next_better->timed.seconds / advice.best->timed.seconds,
                        describe(*advice.next_better, request.measure));
  } else {
    text += "Nothing that was tried is better.\n";
  }
  request.grids = {grid_of(advice.best->point.configuration)};
  if (advice.next_better) request.grids.push_back(grid_of(advice.next_better->point.configuration));
  stats::write_text(folder / "advice.toml",
                    trade_toml(request, folder,
                               "The cheapest with " + budget +
                                   ", and the next better behind it.\n"
                                   "Measured by: touchstone run advice.toml"));
  stats::write_text(folder / "advice.txt", text);
  fmt::print("{}\n{}: `touchstone run` measures it again\n", text,
             (folder / "advice.toml").string());
  return exit_done;
}

}  // namespace

void add_advise(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "advise", "The cheapest configuration for a scene that is right enough, by measuring");
  command->add_option("scene", options->scene, "Scene file: .toml or rigid-ipc's .json")
      ->required();
  command->add_option("--max-error", options->budget.most, "The greatest error that will do")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--no-false-negatives", options->budget.no_false_negatives,
                    "No contact may be missed, or be left without an answer");
  command->add_option("--error", options->error, "What counts as the error of a configuration")
      ->check(CLI::IsMember(
          std::vector<std::string>(error_measure_names.begin(), error_measure_names.end())));
  command->add_option(
      "--out", options->out,
      "Folder for advice.toml (default: results/local/trade-NAME-advice in the project)");
  add_trade_axes(*command, options->request);
  command->callback([options, &status] { status = advise(*options); });
}

}  // namespace touchstone
