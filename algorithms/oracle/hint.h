// Part of the oracle: GJK in doubles. It gives an answer if a bound on its rounding proves it, and
// a start for the integers otherwise.
// Paper:   Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
//          objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988.
// Steps:   1. Start in the direction between the origins.
//          2. Find the point of the difference that is furthest towards the origin.
//          3. With `decide`: if the plane through that point is beyond the radii and the error
//             bound, the answer is `separated` (polytopes only).
//          4. If the point is already in the simplex or makes no progress, stop with `unknown`.
//          5. Add the point and reduce the simplex to its nearest feature.
//          6. If the simplex contains the origin, stop: the answer is `overlapping` if the origin
//             is inside by more than the error bound, else `unknown`.
//          7. With `decide`: if the nearest point is within the radii, the answer is `overlapping`.
//          8. Otherwise repeat from step 2, at most 64 times.
#pragma once

#include <array>

#include "algorithms/oracle/grid_pair.h"

namespace touchstone::oracle {

struct Hint {
  // Proven for the bodies with their radii; `unknown` if doubles cannot decide.
  Answer answer = Answer::unknown;
  // Points of the difference whose simplex was nearest to the origin, or contained it.
  int size = 0;
  std::array<DifferencePoint, 4> points;
};

// The search ends as soon as the answer is proven if `decide` is set. Otherwise it ends when it has
// the nearest simplex or one that contains the origin.
Hint find_hint(GridPair& pair, const Filters& filters, bool decide);

}  // namespace touchstone::oracle
