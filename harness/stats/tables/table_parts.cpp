// Derives from the verified frames whether a contestant is right, and sums its work. The tables of
// growth with bodies, of speed-up by threads and of executors.
#include "harness/stats/tables/table_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

namespace touchstone::stats {

bool is_wrong(const SampleSet& set, const Contestant& contestant) {
  if (set.key.narrow()) {
    return std::ranges::any_of(contestant.checks,
                               [](const Check& check) { return check.disagreements > 0; });
  }
  // The reference of each frame is the pairs of 'naive', else those that most contestants found.
  const auto naive = std::ranges::find(set.contestants, "naive", &Contestant::name);
  return std::ranges::any_of(contestant.checks, [&](const Check& check) {
    if (check.pair_hash.empty()) return false;
    std::map<std::string, int> votes;
    for (const Contestant& voter : set.contestants) {
      if (naive != set.contestants.end() && &voter != &*naive) continue;
      // An algorithm on several executors has one check, and one vote.
      if (&voter != &*std::ranges::find(set.contestants, voter.name(), &Contestant::name)) continue;
      for (const Check& other : voter.checks) {
        if (other.frame == check.frame && !other.pair_hash.empty()) ++votes[other.pair_hash];
      }
    }
    const auto most =
        std::ranges::max_element(votes, {}, [](const auto& vote) { return vote.second; });
    return most != votes.end() && votes[check.pair_hash] < most->second;
  });
}

bool is_right(const SampleSet& set, const Contestant& contestant, double depth_error) {
  return !contestant.failure && !is_wrong(set, contestant) &&
         !(worst_error(contestant) > depth_error) &&
         (!set.key.narrow() || agreement_row(set, contestant).has_value());
}

double worst_error(const Contestant& contestant) {
  double worst = nan;
  for (const Check& check : contestant.checks) worst = std::fmax(worst, check.worst_error);
  return worst;
}

std::optional<AgreementRow> agreement_row(const SampleSet& set, const Contestant& contestant) {
  if (!set.key.narrow()) return std::nullopt;
  AgreementRow row{set.key, contestant.label, contestant.origin};
  row.depth_is_bound = contestant.depth_is_bound;
  for (const Check& check : contestant.checks) {
    if (check.pair_count < 0) continue;
    const std::int64_t wrong = std::max<std::int64_t>(check.disagreements, 0);
    const std::int64_t failed = std::max<std::int64_t>(check.failures, 0);
    const std::int64_t compared = check.compared >= 0 ? check.compared : check.pair_count - failed;
    row.queries += check.pair_count;
    row.wrong += wrong;
    row.failed += failed;
    row.right += std::max<std::int64_t>(compared - wrong, 0);
    row.worst_error = std::fmax(row.worst_error, check.worst_error);
    row.worst_disagreement = std::fmax(row.worst_disagreement, check.worst_disagreement);
  }
  row.unanswered = std::max<std::int64_t>(row.queries - row.right - row.wrong - row.failed, 0);
  return row.queries > 0 ? std::optional(row) : std::nullopt;
}

std::optional<WorkRow> work_row(const SampleSet& set, const Contestant& contestant) {
  const bool narrow = set.key.narrow();
  WorkRow row{set.key, contestant.label, contestant.origin};
  std::array<double, work_count> sums;
  sums.fill(nan);
  for (const Check& check : contestant.checks) {
    if (check.pair_count >= 0) {  // rows of a build or an update have none
      ++row.frames;
      row.queries += check.pair_count;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (check.work[i] < 0) continue;
      const auto count = static_cast<double>(check.work[i]);
      sums[i] = std::isnan(sums[i]) ? count : sums[i] + count;
    }
  }
  const auto per = [&](Work work, double units) {
    return units > 0 ? sums[static_cast<std::size_t>(work)] / units : nan;
  };
  const auto frames = static_cast<double>(row.frames);
  const auto queries = static_cast<double>(row.queries);
  const double body_frames = frames * static_cast<double>(set.key.bodies);
  row.box_tests = per(Work::box_tests, body_frames);
  row.node_visits = per(Work::node_visits, body_frames);
  row.candidates = per(Work::candidates, queries);
  row.bytes = per(Work::bytes, body_frames);
  row.iterations = per(Work::iterations, queries);
  row.support_calls = per(Work::support_calls, queries);
  row.allocations = per(Work::allocations, narrow ? queries : frames);
  row.allocated_bytes = per(Work::allocated_bytes, narrow ? queries : frames);
  const bool any = std::ranges::any_of(sums, [](double sum) { return !std::isnan(sum); });
  return any ? std::optional(row) : std::nullopt;
}

namespace {

struct Points {
  std::vector<double> counts, seconds;
};

Points from(const Points& points, std::int64_t least) {
  Points some;
  for (std::size_t i = 0; i < points.counts.size(); ++i) {
    if (points.counts[i] < static_cast<double>(least)) continue;
    some.counts.push_back(points.counts[i]);
    some.seconds.push_back(points.seconds[i]);
  }
  return some;
}

}  // namespace

std::vector<ExponentRow> exponent_rows(const std::vector<TimeRow>& times) {
  std::vector<ExponentRow> rows;
  std::vector<Points> points;
  for (const TimeRow& time : times) {
    if (time.key.narrow() || std::isnan(time.seconds.median)) continue;
    SetKey key = time.key;
    key.bodies = 0;
    key.seed = key.scene_hash = "";
    auto at = std::ranges::find_if(
        rows, [&](const ExponentRow& row) { return row.key == key && row.label == time.label; });
    if (at == rows.end()) {
      points.emplace_back();
      at = rows.insert(rows.end(), {key, time.label, {}, {}, {}});
    }
    at->counts.push_back(time.key.bodies);
    Points& own = points[static_cast<std::size_t>(at - rows.begin())];
    own.counts.push_back(static_cast<double>(time.key.bodies));
    own.seconds.push_back(time.seconds.median);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].law = fit_power_law(points[i].counts, points[i].seconds, usual_confidence);
    const Points many = from(points[i], many_bodies);
    rows[i].law_of_many = fit_power_law(many.counts, many.seconds, usual_confidence);
    std::ranges::sort(rows[i].counts);
    const auto repeated = std::ranges::unique(rows[i].counts);
    rows[i].counts.erase(repeated.begin(), repeated.end());
  }
  std::erase_if(rows, [](const ExponentRow& row) { return std::isnan(row.law.exponent); });
  return rows;
}

std::vector<SpeedUpRow> speed_up_rows(const Results& results, Noise noise) {
  std::vector<SpeedUpRow> rows;
  for (const SampleSet& set : results.sets) {
    // The base is the same set with the fewest threads.
    const SampleSet* base = &set;
    bool alone = true;
    for (const SampleSet& other : results.sets) {
      SetKey key = other.key;
      key.threads = set.key.threads;
      if (key != set.key) continue;
      alone = alone && &other == &set;
      if (other.key.threads < base->key.threads) base = &other;
    }
    if (alone) continue;
    for (const Contestant& contestant : set.contestants) {
      const Contestant* alike = base->find(contestant.label);
      // At one thread there is no executor.
      if (alike == nullptr) alike = base->find(contestant.name());
      if (alike == nullptr) continue;
      const MedianInterval speed_up = exponential(shift(
          logs(by_square(contestant, noise)), logs(by_square(*alike, noise)), usual_confidence));
      if (std::isnan(speed_up.median)) continue;
      rows.push_back({set.key, contestant.label, base->key.threads, speed_up});
    }
  }
  return rows;
}

std::vector<ExecutorRow> executor_rows(const Results& results, Noise noise) {
  std::vector<ExecutorRow> rows;
  for (const SampleSet& set : results.sets) {
    for (const Contestant& contestant : set.contestants) {
      const Contestant& base =
          *std::ranges::find(set.contestants, contestant.name(), &Contestant::name);
      if (&base == &contestant || !base.executor || !contestant.executor) continue;
      const MedianInterval ratio = ratio_between(set, contestant, base, noise);
      if (std::isnan(ratio.median)) continue;
      rows.push_back(
          {set.key, contestant.name(), *contestant.executor, *base.executor, ratio, set.suspect});
    }
  }
  return rows;
}

}  // namespace touchstone::stats
