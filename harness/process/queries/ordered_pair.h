// Narrow phases are given pairs with kind_a <= kind_b; these turn a pair round, and its answer
// back.
#pragma once

#include <utility>

#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"

namespace touchstone::process {

// Whether the pair is to be handed over as (b, a).
constexpr bool needs_swap(ShapeKind a, ShapeKind b) { return b < a; }

// The outcome of the pair (b, a), from that of (a, b).
inline Outcome swapped(Outcome outcome) {
  outcome.normal = Vec3d::Zero() - outcome.normal;  // a zero stays positive
  std::swap(outcome.witness_a, outcome.witness_b);
  return outcome;
}

}  // namespace touchstone::process
