// Counts of a check by algorithm, scalar and group of regimes, for all its tables.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/check/check_report.h"

namespace touchstone::check {

struct Totals {
  grade::AnswerCount answers;
  FlipCount flips;
};

class GroupedCounts {
 public:
  explicit GroupedCounts(const CheckReport& report);

  const std::map<CheckedAlgorithm, Totals>& totals() const { return totals_; }
  const std::vector<std::string>& groups() const { return groups_; }
  // Returns null if the algorithm has no answers in the group.
  const grade::AnswerCount* of(const CheckedAlgorithm& algorithm, const std::string& group) const;
  std::string name(const CheckedAlgorithm& algorithm) const;  // such as "gjk double"
  bool is_ours(const CheckedAlgorithm& algorithm) const;

 private:
  const CheckRequest& request_;
  std::map<CheckedAlgorithm, Totals> totals_;
  std::map<std::pair<CheckedAlgorithm, std::string>, grade::AnswerCount> by_group_;
  std::vector<std::string> groups_;
};

// Returns a number of things.
inline std::string count(std::int64_t n) { return std::to_string(n); }

// Returns the first digit and the exponent of an error, or "-" for NaN.
std::string digits(double x);

// Describes the checks of cases, certificates, boxes and broad phases.
std::string checked_text(const CheckReport& report);

}  // namespace touchstone::check
