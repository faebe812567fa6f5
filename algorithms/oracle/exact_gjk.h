// GJK in integers: it ends, since the exact distance of the simplex falls with every step.
// Paper: Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
// objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988; Wolfe, "Finding
// the nearest point in a polytope", Mathematical Programming 11, 1976 (the argument that it ends).
#pragma once

#include "algorithms/oracle/exact_simplex.h"
#include "algorithms/oracle/hint.h"

namespace touchstone::oracle {

struct ExactSearch {
  // Around the origin, or nearest to it; of curved cores, up to the rounding of their points.
  ExactSimplex simplex;
  NearestPlane plane;
  // The plane separates the cores and the search ended there: the simplex need not be the nearest.
  bool decided = false;
};

// Starts at the hint. With `decide` a plane that separates the cores is enough.
ExactSearch search_exactly(GridPair& pair, const Hint& hint, const Filters& filters, bool decide);

}  // namespace touchstone::oracle
