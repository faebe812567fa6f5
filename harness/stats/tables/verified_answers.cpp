// Derives from the verified frames whether a contestant is right, and sums its work.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "harness/stats/tables/table_parts.h"

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

}  // namespace touchstone::stats
