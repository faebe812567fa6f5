#include "harness/trade/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/error.h"
#include "harness/run/clock.h"

namespace touchstone {
namespace {

constexpr double truth_share = 0.15;  // of the seconds; as much again for what is held out
constexpr std::size_t frames_at_first = 2, most_frames = 8, held_out_frames = 4;
constexpr int held_out_seeds = 2;
constexpr std::size_t finalists = 4;
constexpr double hopeless = 4;             // times the time of the quickest, by one reading
constexpr double enough_for_better = 0.3;  // of the seconds of a search, for that of the next

class Search {
 public:
  Search(TradeRequest& request, TradeScene& scene, const Representing& representing,
         const ErrorBudget& budget, const std::function<void(const std::string&)>& said)
      : request_(request),
        scene_(scene),
        representing_(representing),
        budget_(budget),
        said_(said) {}

  Advice run() {
    find_candidates();
    advice_.configurations = all_.size();
    for (const std::size_t frames : {frames_at_first, most_frames}) drop_by_error(frames);
    advice_.within_budget = candidates_.size();
    said_(fmt::format("{} of {} configurations are within the budget ({:.0f} s)",
                      candidates_.size(), all_.size(), watch_.seconds()));
    std::vector<std::size_t> ranked = halve(candidates_, request_.seconds - watch_.seconds());
    for (const std::size_t i : ranked) {
      if (!holds_elsewhere(all_[i])) {
        said_(all_[i].point.configuration.name() + " is over the budget on " + advice_.held_out_on +
              ", and dropped");
        continue;
      }
      advice_.best = all_[i];
      break;
    }
    if (advice_.best) find_next_better();
    return std::move(advice_);
  }

 private:
  void find_candidates() {
    if (request_.grids.empty()) {
      request_.grids = default_grids(request_.task, fastest_broad(scene_.frames, scene_.library));
      add_kinds(scene_.frames, request_.grids);
    }
    GridPoints grid = expand(request_.grids, scene_.frames, scene_.library, request_.task);
    for (TradePoint& point : grid.points) {
      candidates_.push_back(all_.size());
      TradeOutcome& outcome = all_.emplace_back();
      outcome.point = std::move(point);
      const Representations& representations = outcome.point.configuration.representations;
      outcome.representation = spread_of(scene_.library.errors(representations));
      outcome.preparation = scene_.library.seconds(representations);
    }
    const std::vector<std::size_t> order = sampling_order(scene_.frames.frames.size());
    // Every second one is held out.
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool taken = i % 2 == 0 || order.size() < 4;
      if (taken && wanted.size() < most_frames) wanted.push_back(order[i]);
      if (!taken && held_out_.size() < held_out_frames) held_out_.push_back(order[i]);
    }
    truth_ = find_truth(scene_.frames, wanted, truth_share * request_.seconds, request_.threads);
  }

  bool within(const TradeOutcome& outcome) const {
    return meets(budget_, request_.measure, outcome.evaluation, outcome.representation);
  }

  void drop_by_error(std::size_t frames) {
    const std::span<const FrameTruth> known(truth_.data(), std::min(frames, truth_.size()));
    std::vector<TradePoint> points;
    for (const std::size_t i : candidates_) points.push_back(all_[i].point);
    std::vector<Evaluation> found = evaluate(scene_.frames, points, known, request_.task);
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      TradeOutcome& outcome = all_[candidates_[k]];
      outcome.evaluation = std::move(found[k]);
      outcome.error = error_of(outcome.evaluation.errors, outcome.representation, request_.measure);
      if (within(outcome)) left.push_back(candidates_[k]);
    }
    candidates_ = std::move(left);
  }

  double rough(std::size_t i) const { return std::max(1e-7, all_[i].evaluation.rough_seconds()); }

  // Times them, the fewer the longer, and keeps the faster half; the quickest first.
  std::vector<std::size_t> halve(std::vector<std::size_t> left, double seconds) {
    if (left.empty()) return left;
    std::ranges::stable_sort(left, {}, [&](std::size_t i) { return rough(i); });
    const double most = hopeless * rough(left.front());
    while (left.size() > finalists && rough(left.back()) > most) left.pop_back();
    advice_.timed += left.size();
    std::size_t stages = 1;
    for (std::size_t n = left.size(); n > finalists; n = (n + 1) / 2) ++stages;
    const double share = std::max(seconds, 0.3 * request_.seconds) / static_cast<double>(stages);
    for (;;) {
      const bool last = left.size() <= finalists;
      time(left, share, last ? 3 : 1);
      std::ranges::stable_sort(left, [&](std::size_t i, std::size_t j) {
        return all_[i].timed.seconds < all_[j].timed.seconds;
      });
      if (last) return left;
      left.resize(std::max(finalists, (left.size() + 1) / 2));
    }
  }

  void time(const std::vector<std::size_t>& members, double seconds, int processes) {
    std::vector<TradePoint> points;
    std::vector<double> expected;
    for (const std::size_t i : members) {
      points.push_back(all_[i].point);
      expected.push_back(rough(i));
    }
    TimingPlan plan;
    plan.threads = request_.threads;
    plan.seconds = seconds;
    plan.processes = processes;
    plan.seed = request_.seed + members.size();
    PointTimes times =
        time_points(scene_.frames, points, expected, request_.task, plan, [](const auto&) {});
    for (std::size_t k = 0; k < members.size(); ++k) {
      TimedPoint& timed = all_[members[k]].timed;
      timed = std::move(times.points[k]);
      // Last in its order.
      if (timed.status != "ok") timed.seconds = std::numeric_limits<double>::infinity();
    }
    advice_.twin = times.twin;
  }

  // Of other seeds where the scene has them, of other frames where it has not.
  bool holds_elsewhere(const TradeOutcome& outcome) {
    if (!std::isfinite(outcome.timed.seconds)) return false;
    const std::optional<bool> seeds = holds_at_other_seeds(outcome);
    if (seeds) return *seeds;
    if (held_out_.empty()) {
      advice_.held_out = outcome.evaluation;
      advice_.held_out_on = "nothing else: the scene has one frame";
      return true;
    }
    if (held_out_truth_.empty()) {
      // From frame 0 on, whose pairs at rest are in no other frame.
      held_out_truth_ =
          find_truth(scene_.frames, held_out_, truth_share * request_.seconds, request_.threads);
    }
    advice_.held_out =
        evaluate(scene_.frames, {&outcome.point, 1}, held_out_truth_, request_.task).front();
    advice_.held_out_on = fmt::format("{} other frames", held_out_truth_.size());
    return meets(budget_, request_.measure, advice_.held_out, outcome.representation);
  }

  std::optional<bool> holds_at_other_seeds(const TradeOutcome& outcome) {
    TradeRequest elsewhere = request_;
    elsewhere.seconds = std::numeric_limits<double>::infinity();  // made however long it takes
    for (int k = 1; k <= held_out_seeds; ++k) {
      elsewhere.overrides.seed = std::max<std::int64_t>(request_.overrides.seed, 1) + k;
      std::optional<TradeScene> other;
      try {
        other.emplace(elsewhere, representing_);
      } catch (const InputError&) {
        return {};  // a scene without seeds
      }
      const TradeGrid grid = grid_of(outcome.point.configuration);
      const GridPoints points = expand({&grid, 1}, other->frames, other->library, request_.task);
      const std::vector<std::size_t> order = sampling_order(other->frames.frames.size());
      const std::vector<FrameTruth> truth =
          find_truth(other->frames, {order.data(), std::min(order.size(), held_out_frames)},
                     truth_share * request_.seconds / held_out_seeds, request_.threads);
      advice_.held_out_on = fmt::format("seed {}", elsewhere.overrides.seed);
      if (points.points.size() != 1) return false;
      advice_.held_out = evaluate(other->frames, points.points, truth, request_.task).front();
      const RepresentationSpread representation =
          spread_of(other->library.errors(points.points[0].configuration.representations));
      if (!meets(budget_, request_.measure, advice_.held_out, representation)) return false;
    }
    advice_.held_out_on =
        fmt::format("{} other seeds, the last of which is counted here", held_out_seeds);
    return true;
  }

  void find_next_better() {
    std::vector<std::size_t> better;
    for (const std::size_t i : candidates_) {
      if (all_[i].error < advice_.best->error) better.push_back(i);
    }
    if (better.empty()) return;
    const double twin = advice_.twin;
    const std::vector<std::size_t> ranked = halve(better, enough_for_better * request_.seconds);
    if (all_[ranked.front()].ok()) advice_.next_better = all_[ranked.front()];
    advice_.twin = twin;
  }

  TradeRequest& request_;
  TradeScene& scene_;
  const Representing& representing_;
  const ErrorBudget& budget_;
  const std::function<void(const std::string&)>& said_;
  Stopwatch watch_;
  std::vector<TradeOutcome> all_;
  std::vector<std::size_t> candidates_;  // of all, those still in
  std::vector<std::size_t> held_out_;    // frames
  std::vector<FrameTruth> truth_, held_out_truth_;
  Advice advice_;
};

}  // namespace

bool meets(const ErrorBudget& budget, ErrorMeasure measure, const Evaluation& evaluation,
           const RepresentationSpread& representation) {
  if (evaluation.status != "ok") return false;
  const PointErrors& errors = evaluation.errors;
  if (budget.no_false_negatives) {
    if (errors.false_negatives > 0) return false;
    for (std::size_t bin = 0; bin < errors.bins.size(); ++bin) {
      const bool contact = !(gap_range(bin).high > 0);
      if (contact && errors.bins[bin].failed > 0) return false;
    }
  }
  return error_of(errors, representation, measure) <= budget.most;
}

Advice advise(TradeRequest& request, TradeScene& scene, const Representing& representing,
              const ErrorBudget& budget, const std::function<void(const std::string&)>& said) {
  return Search(request, scene, representing, budget, said).run();
}

}  // namespace touchstone
