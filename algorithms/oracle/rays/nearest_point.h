// Part of the oracle: a point against a triangle in integers.
#pragma once

#include <array>

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

using SeenTriangle = std::array<IntegerVector, 3>;  // the vertices from the point

// The point of a triangle that is nearest to the origin: at / scale, and its squared distance.
struct NearestInTriangle {
  Integer top, bottom;
  IntegerVector at;
  Integer scale;
};
NearestInTriangle nearest_of(const SeenTriangle& seen);

}  // namespace touchstone::oracle
