// Sums the counts of a check by algorithm, scalar and group of regimes.
#include "harness/check/grouped_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace touchstone::check {
namespace {

struct Checked {
  std::int64_t cases = 0, unresolved = 0, proven = 0, refused = 0, boxes = 0, boxes_broken = 0;

  explicit Checked(const Tally& tally) {
    for (const JobSummary& job : tally.jobs()) {
      cases += job.cases;
      unresolved += job.unresolved;
      proven += job.proven;
      refused += job.refused;
      boxes += job.boxes;
      boxes_broken += job.boxes_broken;
    }
  }
};

}  // namespace

GroupedCounts::GroupedCounts(const CheckReport& report) : request_(*report.request) {
  for (const auto& [key, counted] : report.tally.answers()) {
    const std::string& group = request_.regimes[key.regime]->group;
    totals_[{key.entry, key.scalar}].answers.add(counted);
    by_group_[{{key.entry, key.scalar}, group}].add(counted);
  }
  for (const auto& [key, counted] : report.tally.flips()) {
    totals_[{key.entry, key.scalar}].flips.add(counted);
  }
  for (const Regime* regime : request_.regimes) {
    if (std::ranges::find(groups_, regime->group) == groups_.end()) {
      groups_.push_back(regime->group);
    }
  }
}

const grade::AnswerCount* GroupedCounts::of(const CheckedAlgorithm& algorithm,
                                            const std::string& group) const {
  const auto at = by_group_.find({algorithm, group});
  return at == by_group_.end() ? nullptr : &at->second;
}

std::string GroupedCounts::name(const CheckedAlgorithm& algorithm) const {
  return request_.name(algorithm);
}

bool GroupedCounts::is_ours(const CheckedAlgorithm& algorithm) const {
  return request_.narrow[algorithm.entry]->info.origin == Origin::ours;
}

std::string digits(double x) {
  if (std::isnan(x)) return "-";
  return x == 0 ? "0" : fmt::format("{:.0e}", x);
}

std::string checked_text(const CheckReport& report) {
  const Checked checked(report.tally);
  std::string text = fmt::format(
      "{} cases, {} of them undecided by the oracle's enclosure; {} exact answers proven by a "
      "certificate, {} refused.\n{} boxes of bodies hold all of their body, {} do not.\n",
      checked.cases, checked.unresolved, checked.proven, checked.refused,
      checked.boxes - checked.boxes_broken, checked.boxes_broken);
  std::map<const BroadPhaseEntry*, std::pair<int, int>> broad;  // good ones, and all
  std::int64_t pairs = 0;
  for (const BroadCheck& check : report.broad) {
    auto& [good, all] = broad[check.entry];
    good += check.good() ? 1 : 0;
    ++all;
    if (check.entry == report.broad.front().entry) pairs += check.pairs;
  }
  if (!broad.empty()) {
    int good = 0;
    for (const auto& [entry, counts] : broad) good += counts.first == counts.second ? 1 : 0;
    text += fmt::format("{} of {} broad phases find all pairs of all {} box scenes ({} pairs).\n",
                        good, broad.size(), broad.begin()->second.second, pairs);
  }
  return text;
}

}  // namespace touchstone::check
