// GJK in doubles: an answer where a bound on its rounding proves it, and a start for integers.
// Paper: Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
// objects in three-dimensional space", IEEE J. Robotics and Automation 4(2), 1988.
#pragma once

#include <array>

#include "algorithms/oracle/grid_pair.h"

namespace touchstone::oracle {

struct Hint {
  // Proven for the bodies, radii and all; unknown where doubles do not tell.
  Answer answer = Answer::unknown;
  // Points of the difference whose simplex was nearest to the origin, or held it.
  int size = 0;
  std::array<DifferencePoint, 4> points;
};

// With `decide` the search ends as soon as the answer is proven; otherwise only where it has the
// nearest simplex, or one around the origin.
Hint find_hint(GridPair& pair, const Filters& filters, bool decide);

}  // namespace touchstone::oracle
