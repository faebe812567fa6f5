// Writes the files of advice and of its verification.
#include "harness/trade/advice/advice_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "harness/files/text_file.h"
#include "harness/record/machine.h"
#include "harness/trade/advice/verification_row.h"

namespace touchstone::trade {
namespace {

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
      "queries, {} witness points\n",
      work.hulls_built, work.shapes_bound, work.updates, work.queries, work.witnesses);
  return text;
}

std::vector<double> errors_of(const std::vector<HeldOutGrade>& grades) {
  std::vector<double> errors;
  for (const HeldOutGrade& grade : grades) errors.push_back(grade.error);
  return errors;
}

std::string errors_text(const std::vector<HeldOutGrade>& grades) {
  return fmt::format("{:.3g}", fmt::join(errors_of(grades), ", "));
}

}  // namespace

std::string advice_text(const Advice& advice, const AdviceProblem& problem) {
  const TradeRequest& request = problem.request;
  std::string text =
      fmt::format("{}: {}; {} configurations, {} within the budget, {} timed\n\n",
                  problem.scene.scene.name, to_string(problem.budget, request.measure),
                  advice.configurations, advice.within_budget, advice.timed);
  if (!advice.best) return text + "Nothing that was tried meets the budget.\n";
  text += fmt::format("Cheapest: {}\n{}", advice.best->point.configuration.name(),
                      describe(*advice.best, request.measure));
  text += "  elsewhere      ";
  if (advice.held_out.empty()) {
    text += advice.held_out_on + "\n\n";
  } else {
    std::int64_t near = 0, missed = 0;
    for (const HeldOutGrade& grade : advice.held_out) {
      near += grade.near;
      missed += grade.missed;
    }
    text += fmt::format("{} on {}: {} pairs, {} missed\n\n", errors_text(advice.held_out),
                        advice.held_out_on, near, missed);
  }
  if (!advice.next_better) return text + "Nothing that was tried is better.\n";
  return text + fmt::format("Next better: {}, for {:.3g} times the time\n{}",
                            advice.next_better->point.configuration.name(),
                            advice.next_better->timed.seconds / advice.best->timed.seconds,
                            describe(*advice.next_better, request.measure));
}

void write_advice(const Advice& advice, const AdviceProblem& problem,
                  const std::filesystem::path& folder) {
  files::write_text(folder / "advice.txt", advice_text(advice, problem));
  if (!advice.best) return;
  TradeRequest request = problem.request;
  request.grids = {grid_of(advice.best->point.configuration)};
  if (advice.next_better) request.grids.push_back(grid_of(advice.next_better->point.configuration));
  files::write_text(folder / "advice.toml",
                    trade_toml(request, folder,
                               "The cheapest with " + to_string(problem.budget, request.measure) +
                                   ", and the next better behind it.\n"
                                   "Measured by: touchstone run advice.toml"));
}

std::string verification_text(const Verification& v) {
  std::string text = v.holds() ? "Verified: " : "Not verified: ";
  text += fmt::format("the error is {:.3g} on the scene", v.choice.error);
  if (v.held_out.empty()) {
    text += fmt::format(", and there is {}", v.held_out_on);
  } else {
    text += fmt::format(" and {} on {}", errors_text(v.held_out), v.held_out_on);
  }
  text += fmt::format(", {} the budget. Of {} configurations {} others are within it",
                      v.within_budget ? "within" : "not within", v.configurations, v.rivals);
  if (v.dropped > 0) text += fmt::format(", of which at least {} fail elsewhere", v.dropped);
  if (v.best.empty()) return text + ".\n";
  return text + fmt::format(
                    "; the fastest is {}. The choice takes {:.3f} ({:.3f} to {:.3f}) times "
                    "its time: {}.\n",
                    v.best, v.ratio.median, v.ratio.low, v.ratio.high,
                    v.time == TimeVerdict::within   ? "within 10 %"
                    : v.time == TimeVerdict::beyond ? "beyond 10 %"
                                                    : "not known to be within 10 %");
}

VerificationRows::VerificationRows(const std::filesystem::path& folder, int draws)
    : draws_(draws),
      folder_({.folder = folder,
               .files = {{"verification.csv", record::header_of<VerificationRow>(draws)}},
               .identity = {{"held_out_scenes", std::to_string(draws)}},
               .notes = record::machine_facts(),
               .start = record::FolderStart::overwrite,
               .work = "verification"}) {}

void VerificationRows::write(const AdviceProblem& problem, const Verification* verification) {
  VerificationRow row;
  const scene::Scene& scene = problem.scene.scene;
  row.scene = scene.name;
  row.scene_hash = scene_hash(scene);
  row.bodies = static_cast<std::int64_t>(scene.size());
  row.task = problem.request.task;
  row.threads = problem.request.threads;
  if (row.threads > 1) row.executor = problem.request.executor;
  row.measure = problem.request.measure;
  row.max_error = problem.budget.most;
  row.no_false_negatives = problem.budget.no_false_negatives;
  if (verification != nullptr) {
    const Verification& v = *verification;
    row.choice = v.choice.point.configuration.name();
    row.error = v.choice.error;
    if (!v.held_out.empty()) row.held_out = v.held_out_on;
    row.errors = errors_of(v.held_out);
    row.within_budget = v.within_budget ? YesNo::yes : YesNo::no;
    row.configurations = static_cast<std::int64_t>(v.configurations);
    row.rivals = static_cast<std::int64_t>(v.rivals);
    row.dropped = static_cast<std::int64_t>(v.dropped);
    row.seconds = v.seconds;
    row.best = v.best;
    row.best_seconds = v.best_seconds;
    row.ratio = v.ratio.median;
    row.ratio_low = v.ratio.low;
    row.ratio_high = v.ratio.high;
    row.rounds = static_cast<std::int64_t>(v.ratio.n);
    row.within_time = v.time;
    row.verified = v.holds() ? YesNo::yes : YesNo::no;
  }
  folder_.write(0, row, draws_);
  folder_.commit();
}

}  // namespace touchstone::trade
