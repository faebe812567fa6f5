#include "harness/trade/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/trade/trade_files.h"

namespace touchstone {
namespace {

constexpr double truth_share = 0.3;  // of the seconds, for all held-out scenes
constexpr double race_share = 0.3;   // of the seconds; as much again and more where that was short
constexpr std::size_t most_rivals = 6;   // in the race
constexpr std::size_t most_graded = 18;  // on held-out scenes
constexpr int processes = 10;

class Verifier {
 public:
  Verifier(const TradeRequest& request, TradeScene& scene, const Representing& representing,
           const ErrorBudget& budget, const std::function<void(const std::string&)>& said)
      : request_(request),
        scene_(scene),
        representing_(representing),
        budget_(budget),
        said_(said) {}

  Verification run(const Configuration& choice, int first_draw, int draws,
                   const std::filesystem::path& folder) {
    measure_grid(choice, folder);
    HeldOutScenes elsewhere(request_, representing_, first_draw, draws,
                            truth_share * request_.seconds / draws);
    found_.held_out_on = elsewhere.name();
    found_.held_out = elsewhere.grade(choice, budget_);
    found_.within_budget = within(found_.choice) && all_within(found_.held_out);
    const std::vector<TradeOutcome> rivals = fastest_rivals(elsewhere);
    said_(fmt::format("against the fastest {} others within the budget", rivals.size()));
    found_.seconds = found_.choice.timed.seconds;
    if (!found_.choice.ok()) {
      found_.time = TimeVerdict::undecided;
    } else if (!rivals.empty()) {
      for (const double times : {1.0, 3.0}) {
        race(rivals, times * race_share * request_.seconds);
        if (found_.time != TimeVerdict::undecided) break;
      }
    }
    return std::move(found_);
  }

 private:
  bool within(const TradeOutcome& outcome) const {
    return meets(budget_, request_.measure, outcome.evaluation, outcome.representation);
  }

  void measure_grid(const Configuration& choice, const std::filesystem::path& folder) {
    TradeRequest whole = request_;
    if (whole.grids.empty()) {
      whole.grids = default_grids(whole.task, fastest_broad(scene_.frames, scene_.library));
      add_kinds(scene_.frames, whole.grids);
    }
    whole.grids.push_back(grid_of(choice));
    std::filesystem::create_directories(folder);
    TradeResult result = measure_trade(whole, scene_, folder, said_);
    write_trade(result, whole, scene_, folder);
    found_.configurations = result.points.size();
    bool has_choice = false;
    for (TradeOutcome& point : result.points) {
      if (point.point.configuration.name() == choice.name()) {
        found_.choice = std::move(point);
        has_choice = true;
      } else if (point.ok() && within(point)) {
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
      if (all_within(elsewhere.grade(rival.point.configuration, budget_))) {
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
    plan.threads = request_.threads;
    plan.seconds = seconds;
    plan.processes = processes;
    plan.seed = request_.seed + points.size();
    const PointTimes times =
        time_points(scene_.frames, points, rough, request_.task, plan, [](const auto&) {});
    const TimedPoint& own = times.points[0];
    found_.seconds = own.seconds;
    found_.time = TimeVerdict::undecided;
    found_.best_seconds = Outcome::none;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const TimedPoint& rival = times.points[i];
      // Written so that the first takes the place of none.
      if (rival.status != "ok" || found_.best_seconds <= rival.seconds) continue;
      found_.best = points[i].configuration.name();
      found_.best_seconds = rival.seconds;
      found_.ratio = {own.seconds / rival.seconds, own.seconds / rival.high,
                      own.seconds / rival.low, static_cast<std::size_t>(rival.rounds)};
      found_.time = time_verdict(found_.ratio);
    }
  }

  const TradeRequest& request_;
  TradeScene& scene_;
  const Representing& representing_;
  const ErrorBudget& budget_;
  const std::function<void(const std::string&)>& said_;
  std::vector<TradeOutcome> rivals_;  // within the budget, by rising time
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

Verification verify(const TradeRequest& request, TradeScene& scene,
                    const Representing& representing, const Configuration& choice,
                    const ErrorBudget& budget, int first_draw, int draws,
                    const std::filesystem::path& folder,
                    const std::function<void(const std::string&)>& said) {
  return Verifier(request, scene, representing, budget, said)
      .run(choice, first_draw, draws, folder);
}

}  // namespace touchstone
