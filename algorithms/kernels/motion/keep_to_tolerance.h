// What becomes of a hit where rounding hides more than the tolerance that was asked for. Used by the casts.
#pragma once

#include <cmath>
#include <optional>

#include "algorithms/core/cast_outcome.h"

namespace touchstone {

// Takes a hit back whose contact is not proven if a distance of `hidden` (metres) cannot be told from contact:
// the bodies may then be further apart than was asked for. The default tolerance is no less than that.
inline void keep_to_tolerance(const std::optional<double>& asked, double hidden,
                              CastOutcome& outcome) {
  const bool is_proven = !std::isnan(outcome.upper);
  if (outcome.answer != CastAnswer::hit || is_proven || asked.value_or(hidden) >= hidden) return;
  CastOutcome open;
  open.status = Status::not_converged;
  open.lower = outcome.lower;
  open.iterations = outcome.iterations;
  outcome = open;
}

}  // namespace touchstone
