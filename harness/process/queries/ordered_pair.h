// Exchanges the bodies of a pair, and of its outcome: narrow phases take kind_a <= kind_b only.
#pragma once

#include <utility>

#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"

namespace touchstone::process {

// Returns whether the pair must be passed as (b, a).
constexpr bool needs_swap(ShapeKind a, ShapeKind b) { return b < a; }

// Turns the outcome of the pair (a, b) into that of (b, a).
inline Outcome swapped(Outcome outcome) {
  outcome.normal = Vec3d::Zero() - outcome.normal;  // 0 - n keeps a zero positive
  std::swap(outcome.witness_a, outcome.witness_b);
  return outcome;
}

}  // namespace touchstone::process
