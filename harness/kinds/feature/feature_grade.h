// The rule that decides whether an answer about moving features is right.
#pragma once

#include "algorithms/ccd.h"
#include "algorithms/oracle/ccd/first_within.h"
#include "algorithms/oracle/oracle.h"
#include "harness/kinds/feature/feature_kind.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// A hit may be later than the contact by so much of the step.
inline constexpr double feature_late = 1e-6;

// The first time at which the features come within the separation (metres, >= 0), by the oracle.
inline oracle::ccd::Impact impact_of(const oracle::ccd::MovingFeatures& features,
                                     double separation) {
  return separation > 0 ? oracle::ccd::impact_within(features, separation)
                        : oracle::ccd::impact_of(features);
}

// A query, and how it was asked.
struct FeatureAsked {
  const CcdQuery* query = nullptr;  // as it was drawn
  int first_count = 1;              // vertices of the first feature
  Lengths lengths;
  bool reversed = false;  // the motion was, from its end to its start: times run backward
};

// `exact` is the first time at which the features come within the separation. With `audits_oracle`, the answer is
// the oracle's own: it is held against distances that do not come from its polynomials.
Graded grade_feature(const CcdOutcome& outcome, const oracle::ccd::Impact& exact,
                     const FeatureAsked& asked, bool audits_oracle, oracle::Oracle& oracle);

}  // namespace touchstone::kinds
