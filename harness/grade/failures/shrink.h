// Shrinks a failing case, so that it can be read.
#pragma once

#include <functional>

#include "harness/files/cases.h"

namespace touchstone::grade {

// Returns whether the case still shows the failure.
using FailurePredicate = std::function<bool(const files::Case&)>;

// Simplifies the case one step at a time, and keeps each step after which still_fails holds:
// - hulls lose vertices;
// - the first body moves to the origin, with the identity as its rotation;
// - hulls take their rotation into their vertices;
// - other rotations become signed permutations, or those of quaternions of small whole numbers;
// - round shapes become spheres;
// - lengths and coordinates become zero or one, or get fewer decimal digits.
// Stops when a whole pass keeps nothing, or after `budget` calls of still_fails. Rotations stay
// rotations, and solids stay solid: sizes that are not zero do not become zero, and hulls keep
// their dimension. The id is kept.
//
// The search is greedy, after Zeller and Hildebrandt, "Simplifying and isolating failure-inducing
// input", 2002 (vertices are dropped in chunks, from half of them down to one). It is deterministic
// if still_fails is. `c` itself is not tried: if it does not fail, the result is `c` or any case
// that does fail.
files::Case shrink(const files::Case& c, const FailurePredicate& still_fails, int budget = 2000);

}  // namespace touchstone::grade
