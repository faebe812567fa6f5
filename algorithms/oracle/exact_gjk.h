// Part of the oracle: GJK in integers. It ends because the exact distance of the simplex falls with
// every step.
// Paper:   Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
//          objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988; Wolfe,
//          "Finding the nearest point in a polytope", Mathematical Programming 11, 1976 (the
//          argument that it ends).
// Steps:   1. Start with the points of the hint.
//          2. Reduce the simplex to the feature that is nearest to the origin (exact_simplex).
//          3. If the simplex contains the origin, stop.
//          4. Find the point of the difference that is furthest towards the origin.
//          5. If only a verdict is needed and the plane through that point separates the cores,
//             stop.
//          6. If the point is no nearer than the feature's plane, that plane supports the whole
//             difference: stop. Curved cores also stop when the progress is below their rounding.
//          7. Otherwise add the point and repeat from step 2.
#pragma once

#include "algorithms/oracle/exact_simplex.h"
#include "algorithms/oracle/hint.h"

namespace touchstone::oracle {

struct ExactSearch {
  // The simplex contains the origin or is nearest to it; for curved cores this holds up to the
  // rounding of their points.
  ExactSimplex simplex;
  NearestPlane plane;
  // True if the search ended at a plane that separates the cores; the simplex may then not be the
  // nearest one.
  bool decided = false;
};

// Starts at the hint. With `decide` the search may end at a plane that separates the cores.
ExactSearch search_exactly(GridPair& pair, const Hint& hint, const Filters& filters, bool decide);

}  // namespace touchstone::oracle
