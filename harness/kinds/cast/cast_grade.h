// The rule that decides whether an answer about two moving bodies is right.
#pragma once

#include <cstddef>
#include <optional>

#include "algorithms/cast.h"
#include "harness/kinds/cast/cast_kind.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// A time that is promised to be in time may be late by so much of the step, which is rounding.
inline constexpr double cast_late = 1e-14;

// The tolerance (metres) by which the answers are judged: what was asked, or the algorithm's own. `path` and `size`
// are of the bodies, in metres.
double cast_tolerance(const CastEntry& entry, std::optional<double> asked, double path,
                      double size);

// How the case was asked.
struct CastAsked {
  std::size_t place = 0;  // of the case in the truths
  double tolerance = 0;   // metres
  StartContact start = StartContact::counts;
  bool reversed = false;  // the motion was, from its end to its start: times run backward
};

// `exact` is the oracle's answer to the case as it was asked.
Graded grade_cast(const CastOutcome& outcome, const CastOutcome& exact, const CastAsked& asked,
                  bool in_time, CastTruths& truths);

}  // namespace touchstone::kinds
