// The search for advice: errors first, then successive halving by time.
#include "harness/trade/advice/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "harness/base/clock.h"

namespace touchstone::trade {
namespace {

constexpr double truth_share = 0.15;  // share of the seconds; held-out scenes get as much again
constexpr std::size_t frames_at_first = 2, most_frames = 8;
constexpr std::size_t finalists = 4;
constexpr double hopeless = 4;  // multiples of the quickest configuration's time, by one reading
constexpr double first_search = 0.6;  // share of the seconds left, if more is to be tried
constexpr double least_search = 0.3;  // share of all seconds, however many are spent before
// share of a search's seconds, for the search of the next better
constexpr double enough_for_better = 0.3;

class Search {
 public:
  explicit Search(const AdviceProblem& problem) : problem_(problem) {}

  Advice run() {
    const bool chooses_grids = problem_.request.grids.empty();
    std::vector<std::size_t> order = sampling_order(problem_.scene.frames.frames.size());
    order.resize(std::min(order.size(), most_frames));
    truth_ = find_truth(problem_.scene.frames, order, truth_share * problem_.request.seconds,
                        problem_.request.threads);
    candidates_ = within_budget(chooses_grids ? usual_grids() : problem_.request.grids);
    problem_.said(fmt::format("{} of {} configurations are within the budget ({:.0f} s)",
                              candidates_.size(), all_.size(), watch_.seconds()));
    std::vector<std::size_t> ranked =
        halve(candidates_, (chooses_grids ? first_search : 1) * seconds_left());
    if (chooses_grids && !ranked.empty()) ranked = with_like(ranked);
    advice_.configurations = all_.size();
    advice_.within_budget = candidates_.size();
    choose(ranked);
    if (advice_.best) find_next_better();
    advice_.hulls_built = problem_.scene.library.hulls();
    return std::move(advice_);
  }

 private:
  double seconds_left() const { return problem_.request.seconds - watch_.seconds(); }

  std::vector<TradeGrid> usual_grids() {
    std::vector<TradeGrid> grids = default_grids(
        problem_.request.task, fastest_broad(problem_.scene.frames, problem_.scene.library));
    add_kinds(problem_.scene.frames, grids);
    for (TradeGrid& grid : grids) {
      for (Representations& representations : grid.representations) {
        representations.of[static_cast<std::size_t>(ShapeKind::sphere)].reset();
      }
    }
    return grids;
  }

  // Adds the configurations of these grids that are not tried yet, and keeps those within the
  // budget.
  std::vector<std::size_t> within_budget(std::span<const TradeGrid> grids) {
    GridPoints grid =
        expand(grids, problem_.scene.frames, problem_.scene.library, problem_.request.task);
    std::vector<std::size_t> added;
    for (TradePoint& point : grid.points) {
      if (!names_.insert(point.configuration.name()).second) continue;
      added.push_back(all_.size());
      TradeOutcome& outcome = all_.emplace_back();
      outcome.point = std::move(point);
      const Representations& representations = outcome.point.configuration.representations;
      outcome.representation = spread_of(problem_.scene.library.errors(representations));
      outcome.preparation = problem_.scene.library.seconds(representations);
    }
    for (const std::size_t frames : {frames_at_first, most_frames}) drop_by_error(frames, added);
    return added;
  }

  // The winners of different axes may never have met, so the best one is combined with every other
  // broad phase and with every other narrow phase.
  std::vector<std::size_t> with_like(const std::vector<std::size_t>& ranked) {
    const std::vector<TradeGrid> grids =
        grids_like(all_[ranked.front()].point.configuration, problem_.request.task);
    const std::vector<std::size_t> like = within_budget(grids);
    problem_.said(fmt::format("{} more like {} ({:.0f} s)", like.size(),
                              all_[ranked.front()].point.configuration.name(), watch_.seconds()));
    candidates_.insert(candidates_.end(), like.begin(), like.end());
    const auto behind =
        ranked.begin() + static_cast<std::ptrdiff_t>(std::min(ranked.size(), finalists));
    std::vector<std::size_t> again(ranked.begin(), behind);
    again.insert(again.end(), like.begin(), like.end());
    again = halve(std::move(again), seconds_left());
    again.insert(again.end(), behind, ranked.end());
    return again;
  }

  void choose(std::span<const std::size_t> ranked) {
    if (ranked.empty()) return;
    HeldOutScenes elsewhere(problem_.request, problem_.representing, 1, advice_draws,
                            truth_share * problem_.request.seconds / advice_draws);
    advice_.held_out_on = elsewhere.name();
    for (const std::size_t i : ranked) {
      if (!std::isfinite(all_[i].timed.seconds)) continue;
      advice_.held_out = elsewhere.grade(all_[i].point.configuration, problem_.budget);
      if (all_within(advice_.held_out)) {
        advice_.best = all_[i];
        return;
      }
      problem_.said(all_[i].point.configuration.name() + " is over the budget on " +
                    elsewhere.name() + ", and dropped");
    }
  }

  bool within(const TradeOutcome& outcome) const {
    return meets(problem_.budget, problem_.request.measure, outcome.evaluation,
                 outcome.representation);
  }

  void drop_by_error(std::size_t frames, std::vector<std::size_t>& members) {
    const std::span<const FrameTruth> known(truth_.data(), std::min(frames, truth_.size()));
    std::vector<TradePoint> points;
    points.reserve(members.size());
    for (const std::size_t i : members) points.push_back(all_[i].point);
    std::vector<Evaluation> found =
        evaluate(problem_.scene.frames, points, known, problem_.request.task);
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < members.size(); ++k) {
      TradeOutcome& outcome = all_[members[k]];
      outcome.evaluation = std::move(found[k]);
      outcome.error =
          error_of(outcome.evaluation.errors, outcome.representation, problem_.request.measure);
      if (within(outcome)) left.push_back(members[k]);
    }
    members = std::move(left);
  }

  double rough(std::size_t i) const { return std::max(1e-7, all_[i].evaluation.rough_seconds()); }

  // Times them, the fewer the longer, and keeps the faster half; returns all, the quickest first.
  std::vector<std::size_t> halve(std::vector<std::size_t> left, double seconds) {
    if (left.empty()) return left;
    std::ranges::stable_sort(left, {}, [&](std::size_t i) { return rough(i); });
    const double most = hopeless * rough(left.front());
    while (left.size() > finalists && rough(left.back()) > most) left.pop_back();
    advice_.timed += left.size();
    std::size_t stages = 1;
    for (std::size_t n = left.size(); n > finalists; n = (n + 1) / 2) ++stages;
    const double share =
        std::max(seconds, least_search * problem_.request.seconds) / static_cast<double>(stages);
    std::vector<std::size_t> slower;
    for (;;) {
      const bool last = left.size() <= finalists;
      time(left, share, last ? 3 : 1);
      std::ranges::stable_sort(left, [&](std::size_t i, std::size_t j) {
        return all_[i].timed.seconds < all_[j].timed.seconds;
      });
      if (last) break;
      const auto half =
          left.begin() + static_cast<std::ptrdiff_t>(std::max(finalists, (left.size() + 1) / 2));
      slower.insert(slower.begin(), half, left.end());
      left.erase(half, left.end());
    }
    left.insert(left.end(), slower.begin(), slower.end());
    return left;
  }

  void time(const std::vector<std::size_t>& members, double seconds, int processes) {
    std::vector<TradePoint> points;
    std::vector<double> expected;
    for (const std::size_t i : members) {
      points.push_back(all_[i].point);
      expected.push_back(rough(i));
    }
    TimingPlan plan;
    plan.threads = problem_.request.threads;
    plan.executor = problem_.request.executor;
    plan.seconds = seconds;
    plan.processes = processes;
    plan.seed = problem_.request.seed + members.size();
    PointTimes times = time_points(problem_.scene.frames, points, expected, problem_.request.task,
                                   plan, [](const auto&) {});
    for (std::size_t k = 0; k < members.size(); ++k) {
      TimedPoint& timed = all_[members[k]].timed;
      timed = std::move(times.points[k]);
      // A configuration without a time becomes the last in the order.
      if (!timed.ok()) timed.seconds = std::numeric_limits<double>::infinity();
    }
    advice_.control = times.control;
  }

  void find_next_better() {
    std::vector<std::size_t> better;
    for (const std::size_t i : candidates_) {
      if (all_[i].error < advice_.best->error) better.push_back(i);
    }
    if (better.empty()) return;
    const double control = advice_.control;
    const std::vector<std::size_t> ranked =
        halve(better, enough_for_better * problem_.request.seconds);
    if (all_[ranked.front()].ok()) advice_.next_better = all_[ranked.front()];
    advice_.control = control;
  }

  const AdviceProblem& problem_;
  base::Stopwatch watch_;
  std::vector<TradeOutcome> all_;
  std::set<std::string> names_;          // the names of all configurations tried
  std::vector<std::size_t> candidates_;  // indices of those within the budget
  std::vector<FrameTruth> truth_;
  Advice advice_;
};

}  // namespace

Advice advise(const AdviceProblem& problem) { return Search(problem).run(); }

}  // namespace touchstone::trade
