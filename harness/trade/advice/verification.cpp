// Verifies advice: measures the grid, then races the choice against its rivals.
#include "harness/trade/advice/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace touchstone::trade {
namespace {

constexpr double held_out_share = 0.3;  // share of the seconds, for all held-out scenes
// share of the seconds; a second race gets as much again or more
constexpr double race_share = 0.3;
constexpr std::size_t most_rivals = 6;   // the number in the race
constexpr std::size_t most_graded = 18;  // the number graded on held-out scenes
constexpr int processes = 10;

class Verifier {
 public:
  explicit Verifier(const AdviceProblem& problem) : problem_(problem) {}

  Verification run(const Configuration& choice, int first_draw, int draws,
                   const std::filesystem::path& folder) {
    measure_grid(choice, folder);
    HeldOutScenes elsewhere(problem_.request, problem_.representing, first_draw, draws,
                            held_out_share * problem_.request.seconds / draws);
    found_.held_out_on = elsewhere.name();
    found_.held_out = elsewhere.grade(choice, problem_.budget);
    found_.within_budget = within(problem_, found_.choice) && all_within(found_.held_out);
    const std::vector<TradeOutcome> rivals = fastest_rivals(elsewhere);
    problem_.said(fmt::format("against the fastest {} others within the budget", rivals.size()));
    found_.seconds = found_.choice.timed.seconds;
    if (!found_.choice.ok()) {
      found_.time = TimeVerdict::undecided;
    } else if (!rivals.empty()) {
      for (const double times : {1.0, 3.0}) {
        race(rivals, times * race_share * problem_.request.seconds);
        if (found_.time != TimeVerdict::undecided) break;
      }
    }
    return std::move(found_);
  }

 private:
  void measure_grid(const Configuration& choice, const std::filesystem::path& folder) {
    TradeRequest whole = problem_.request;
    if (whole.grids.empty()) {
      whole.grids =
          default_grids(whole.task, fastest_broad(problem_.scene.frames, problem_.scene.library));
      add_kinds(problem_.scene.frames, whole.grids);
    }
    whole.grids.push_back(grid_of(choice));
    TradeResult result = measure_trade(whole, problem_.scene, folder, problem_.said);
    found_.configurations = result.points.size();
    bool has_choice = false;
    for (TradeOutcome& point : result.points) {
      if (point.point.configuration.name() == choice.name()) {
        found_.choice = std::move(point);
        has_choice = true;
      } else if (point.ok() && within(problem_, point)) {
        rivals_.push_back(std::move(point));
      }
    }
    if (!has_choice) throw std::logic_error("the grid has not the choice");
    found_.rivals = rivals_.size();
    std::ranges::stable_sort(rivals_, {},
                             [](const TradeOutcome& rival) { return rival.timed.seconds; });
  }

  std::vector<TradeOutcome> fastest_rivals(HeldOutScenes& elsewhere) {
    std::vector<TradeOutcome> fastest;
    for (const TradeOutcome& rival : rivals_) {
      if (fastest.size() == most_rivals || fastest.size() + found_.dropped == most_graded) break;
      if (all_within(elsewhere.grade(rival.point.configuration, problem_.budget))) {
        fastest.push_back(rival);
      } else {
        ++found_.dropped;
      }
    }
    return fastest;
  }

  // The choice is the baseline, so that each round gives one ratio to each rival.
  void race(const std::vector<TradeOutcome>& rivals, double seconds) {
    std::vector<TradePoint> points = {found_.choice.point};
    std::vector<double> rough = {found_.choice.timed.seconds};
    for (const TradeOutcome& rival : rivals) {
      points.push_back(rival.point);
      rough.push_back(rival.timed.seconds);
    }
    TimingPlan plan;
    plan.threads = problem_.request.threads;
    plan.executor = problem_.request.executor;
    plan.seconds = seconds;
    plan.processes = processes;
    plan.seed = problem_.request.seed + points.size();
    const PointTimes times = time_points(problem_.scene.frames, points, rough,
                                         problem_.request.task, plan, [](const auto&) {});
    const TimedPoint& own = times.points[0];
    found_.seconds = own.seconds;
    found_.time = TimeVerdict::undecided;
    found_.best_seconds = Outcome::none;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const TimedPoint& rival = times.points[i];
      // The condition is true for a first ratio too, which is compared with none (NaN).
      if (!rival.ok() || found_.best_seconds <= rival.seconds) continue;
      found_.best = points[i].configuration.name();
      found_.best_seconds = rival.seconds;
      found_.ratio = {own.seconds / rival.seconds, own.seconds / rival.high,
                      own.seconds / rival.low, static_cast<std::size_t>(rival.rounds)};
      found_.time = time_verdict(found_.ratio);
    }
  }

  const AdviceProblem& problem_;
  std::vector<TradeOutcome> rivals_;  // those within the budget, by rising time
  Verification found_;
};

}  // namespace

std::string_view to_string(TimeVerdict verdict) {
  switch (verdict) {
    case TimeVerdict::within: return "yes";
    case TimeVerdict::beyond: return "no";
    case TimeVerdict::undecided: break;
  }
  return "undecided";
}

TimeVerdict time_verdict(const stats::MedianInterval& ratio) {
  if (ratio.high <= allowed_ratio) return TimeVerdict::within;
  return ratio.low > allowed_ratio ? TimeVerdict::beyond : TimeVerdict::undecided;
}

Verification verify(const AdviceProblem& problem, const Configuration& choice, int first_draw,
                    int draws, const std::filesystem::path& folder) {
  return Verifier(problem).run(choice, first_draw, draws, folder);
}

}  // namespace touchstone::trade
