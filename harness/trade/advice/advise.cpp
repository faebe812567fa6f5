// The search for advice: errors first, then successive halving by time.
#include "harness/trade/advice/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "harness/base/clock.h"

namespace touchstone::trade {
namespace {

constexpr double truth_share = 0.15;  // share of the seconds
constexpr std::size_t frames_at_first = 2, most_frames = 8;
constexpr std::size_t finalists = 4;
constexpr double hopeless = 4;  // multiples of the quickest configuration's time, by one reading
constexpr double first_search = 0.6;  // share of the seconds left, if more is to be tried
// Shares of all seconds: of the search, of a step of it however many are spent before, of tests on held-out scenes, of
// the search of the next better and of the rival, and of the last timing, of all that are in the table together.
constexpr double search_share = 0.6, least_search = 0.15, test_share = 0.25, better_share = 0.15,
                 rival_share = 0.1, table_share = 0.15;

// However few seconds there are, tests may take so many, for a test of a few pairs is none.
constexpr double least_test_seconds = 5;

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
    count_libraries();
    if (best_) {
      find_next_better();
      find_rival();
      time_together();
    }
    advice_.hulls_built = problem_.scene.library.hulls();
    return std::move(advice_);
  }

 private:
  double seconds_left() const { return search_share * problem_.request.seconds - watch_.seconds(); }

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

  enum class Verdict : std::uint8_t { right, wrong, unknown };
  struct Test {
    Verdict verdict = Verdict::unknown;
    std::vector<HeldOutGrade> grades;
    std::vector<Evidence> evidence;
  };

  void choose(std::span<const std::size_t> ranked) {
    if (ranked.empty()) return;
    const base::Stopwatch watch;
    const double seconds = std::max(least_test_seconds, test_share * problem_.request.seconds);
    elsewhere_.emplace(problem_.request, problem_.representing, 1, advice_draws,
                       seconds / 2 / advice_draws);
    const auto keep = [&](Test& test) {
      advice_.held_out = std::move(test.grades);
      advice_.evidence = std::move(test.evidence);
      advice_.held_out_on = elsewhere_->name();
    };
    for (const std::size_t i : ranked) {
      if (!std::isfinite(all_[i].timed.seconds)) continue;
      // Without a contact nothing shows that none is missed.
      const bool has_contacts = all_[i].evaluation.errors.contacts > 0;
      if (!has_contacts && can_miss(all_[i].point.configuration.representations)) continue;
      Test test = tested(i, watch, seconds);
      if (test.verdict == Verdict::right) {
        best_ = i;
        advice_.untested.reset();
        return keep(test);
      }
      if (test.verdict == Verdict::wrong) {
        problem_.said(all_[i].point.configuration.name() + " is over the budget on " +
                      elsewhere_->name() + ", or may miss contacts, and dropped");
        continue;
      }
      const bool is_flawless = std::ranges::all_of(
          test.evidence, [](const Evidence& evidence) { return evidence.wrong == 0; });
      if (!advice_.untested) {
        advice_.untested = all_[i];
        keep(test);
      }
      if (is_flawless) return;  // the same pairs show no more of another
    }
  }

  // Tests a configuration on held-out scenes, and draws more of them as long as they do not decide and there is time.
  Test tested(std::size_t i, const base::Stopwatch& watch, double seconds) {
    const TradeOutcome& outcome = all_[i];
    const ErrorMeasure measure = problem_.request.measure;
    const bool is_share =
        measure == ErrorMeasure::verdicts || measure == ErrorMeasure::false_negatives;
    Test test;
    for (;;) {
      const auto more =
          elsewhere_->grade(outcome.point.configuration, problem_.budget, test.grades.size());
      test.grades.insert(test.grades.end(), more.begin(), more.end());
      Evaluation sum = outcome.evaluation;
      if (!elsewhere_->empty()) sum.errors = sum_of(test.grades);
      test.evidence = evidence_for(problem_.budget, measure, sum.errors);
      const bool has_failed = std::ranges::any_of(
          test.grades, [](const HeldOutGrade& grade) { return std::isnan(grade.error); });
      const bool is_within = is_share ? meets(problem_.budget, measure, sum, outcome.representation)
                                      : all_within(test.grades);
      if (has_failed || !is_within) {
        test.verdict = Verdict::wrong;
        return test;
      }
      if (std::ranges::all_of(test.evidence, &Evidence::holds)) {
        const bool is_blind =
            sum.errors.contacts == 0 && can_miss(outcome.point.configuration.representations);
        test.verdict = is_blind ? Verdict::wrong : Verdict::right;
        return test;
      }
      const double left = seconds - watch.seconds();
      const auto drawn = static_cast<int>(elsewhere_->size());
      if (drawn == 0 || left <= 0 || !elsewhere_->draw(drawn, left)) return test;
    }
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
      if (within(problem_, outcome)) left.push_back(members[k]);
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
      if (all_[i].error < all_[*best_].error) better.push_back(i);
    }
    if (better.empty()) return;
    const std::size_t first = halve(better, better_share * problem_.request.seconds).front();
    if (all_[first].ok()) next_better_ = first;
  }

  void count_libraries() {
    for (const TradeOutcome& outcome : all_) {
      if (!uses_library(outcome.point.configuration)) continue;
      ++advice_.with_library;
      // The condition is true for a first error too, which is compared with none (NaN).
      const bool is_less = !(advice_.least_library_error <= outcome.error);
      if (outcome.evaluation.ok() && is_less) advice_.least_library_error = outcome.error;
    }
  }

  void find_rival() {
    const bool of_library = !uses_library(all_[*best_].point.configuration);
    std::vector<std::size_t> others;
    for (const std::size_t i : candidates_) {
      if (uses_library(all_[i].point.configuration) == of_library) others.push_back(i);
    }
    if (others.empty()) return;
    const base::Stopwatch watch;
    for (const std::size_t i : halve(others, rival_share * problem_.request.seconds)) {
      if (!std::isfinite(all_[i].timed.seconds)) continue;
      if (tested(i, watch, 0).verdict == Verdict::wrong) continue;
      rival_ = i;
      return;
    }
  }

  // The times of a table come from the same rounds.
  void time_together() {
    std::vector<std::size_t> members = {*best_};
    for (const auto& other : {next_better_, rival_}) {
      if (other && std::ranges::find(members, *other) == members.end()) members.push_back(*other);
    }
    if (members.size() > 1) time(members, table_share * problem_.request.seconds, 3);
    advice_.best = all_[*best_];
    if (next_better_) advice_.next_better = all_[*next_better_];
    if (rival_) advice_.rival = all_[*rival_];
  }

  const AdviceProblem& problem_;
  base::Stopwatch watch_;
  std::vector<TradeOutcome> all_;
  std::set<std::string> names_;          // the names of all configurations tried
  std::vector<std::size_t> candidates_;  // indices of those within the budget
  std::vector<FrameTruth> truth_;
  std::optional<HeldOutScenes> elsewhere_;
  std::optional<std::size_t> best_, next_better_, rival_;  // indices
  Advice advice_;
};

}  // namespace

bool uses_library(const Configuration& configuration) {
  const auto is_library = [](const auto* entry) {
    return entry != nullptr && entry->info.origin == Origin::peer;
  };
  return is_library(configuration.broad) || is_library(configuration.concave) ||
         std::ranges::any_of(configuration.narrow, is_library);
}

Advice advise(const AdviceProblem& problem) { return Search(problem).run(); }

}  // namespace touchstone::trade
