// Makes a failing case small, so that a person can read it.
#pragma once

#include <functional>

#include "harness/files/cases.h"

namespace touchstone::grade {

// Whether the case still shows the failure.
using FailurePredicate = std::function<bool(const files::Case&)>;

// Changes the case, one thing at a time, to something simpler, and keeps each change after which
// still_fails holds: hulls lose vertices, the first body goes to the origin with the identity as
// its rotation, hulls take their rotation into their vertices, other rotations become signed
// permutations or those of quaternions of small whole numbers, round shapes become spheres, and
// lengths and coordinates become zero or one, or get fewer decimal digits. Goes round until nothing
// more is kept, or still_fails was called `budget` times. Rotations stay rotations, and what is
// solid stays solid: sizes that are not zero do not become zero, and hulls keep their dimension.
//
// Greedy, after Zeller and Hildebrandt, "Simplifying and isolating failure-inducing input", 2002
// (the vertices are dropped in chunks, from half of them down to one). The same calls and the same
// result each time, as long as still_fails answers the same. `c` itself is not tried: where it does
// not fail, what comes back may be anything that does, or `c`. The id is kept.
files::Case shrink(const files::Case& c, const FailurePredicate& still_fails, int budget = 2000);

}  // namespace touchstone::grade
