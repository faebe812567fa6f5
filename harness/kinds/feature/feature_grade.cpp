// Grades answers about moving features.
#include "harness/kinds/feature/feature_grade.h"

#include <cmath>

#include "harness/kinds/feature/feature_kind.h"
#include "harness/kinds/grading.h"

namespace touchstone::kinds {
namespace {

constexpr double oracle_late = 0x1p-39;  // of the step, between the oracle's bounds

// True if the features are further apart at the time than separation and tolerance.
bool is_apart(const FeatureAsked& asked, double time, oracle::Oracle& oracle) {
  if (!(time >= 0 && time <= 1)) return true;
  return are_further_apart(*asked.query, asked.first_count, time,
                           asked.lengths.separation + 1.01 * asked.lengths.tolerance, oracle);
}

// True if distances at some times are not what the oracle's answer says, up to the 2^-40 between its
// bounds. They do not come from its polynomials.
bool contradicts(const CcdOutcome& outcome, const FeatureAsked& asked, oracle::Oracle& oracle) {
  const bool is_hit = outcome.answer == CcdAnswer::hit;
  const auto side = [&](double time) {
    return side_of_distance(*asked.query, asked.first_count, time, asked.lengths.separation,
                            oracle);
  };
  const double free_until = is_hit ? outcome.free_before : 1;
  for (const double part : {0.25, 0.5, 0.75}) {
    if (free_until > 0 && side(part * free_until) < 0) return true;
  }
  return is_hit && side(outcome.contact_by) > 0;
}

// The time by which it says that there was contact.
double contact_of(const CcdOutcome& outcome) {
  return std::isnan(outcome.contact_by) ? outcome.toi : outcome.contact_by;
}

// True if a hit's times are not those of the contact: late, or so early that the features are apart.
bool is_off(const CcdOutcome& outcome, const oracle::ccd::Impact& exact, const FeatureAsked& asked,
            bool audits_oracle, oracle::Oracle& oracle) {
  if (audits_oracle) {
    return !(outcome.free_before <= exact.contact_by + oracle_late) ||
           !(outcome.contact_by >= exact.free_before - oracle_late) ||
           contradicts(outcome, asked, oracle);
  }
  if (!(outcome.toi <= exact.contact_by + feature_late)) return true;
  return is_apart(asked, contact_of(outcome), oracle);
}

}  // namespace

Graded grade_feature(const CcdOutcome& outcome, const oracle::ccd::Impact& exact,
                     const FeatureAsked& asked, bool audits_oracle, oracle::Oracle& oracle) {
  const auto with = [&](Grade grade) { return Graded{grade, exact.is_hit}; };
  const bool is_unknown = outcome.answer == CcdAnswer::unknown;
  // What is said to be free is said to be proven, even where the answer is unknown.
  const bool is_late = !asked.reversed && exact.is_hit && outcome.free_before > exact.contact_by;
  if (is_late && outcome.answer != CcdAnswer::miss) return with(Grade::inexact);
  if (const auto by_status = grade_of_status(outcome.status, is_unknown)) return with(*by_status);
  if (outcome.answer == CcdAnswer::miss) {
    const bool is_wrong = exact.is_hit || (audits_oracle && contradicts(outcome, asked, oracle));
    return with(is_wrong ? Grade::missed : Grade::right);
  }
  if (!exact.is_hit) {
    const double by = contact_of(outcome);
    const bool is_false = is_apart(asked, asked.reversed ? 1 - by : by, oracle);
    return with(is_false ? Grade::false_hit : Grade::near);
  }
  const bool is_inexact = !asked.reversed && is_off(outcome, exact, asked, audits_oracle, oracle);
  return with(is_inexact ? Grade::inexact : Grade::right);
}

}  // namespace touchstone::kinds
