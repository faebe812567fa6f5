// Part of the oracle, used by linear_search: the point of a simplex that is nearest to the origin,
// in integers.
#pragma once

#include <vector>

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// The point `numerator` / `denominator`, with denominator > 0.
struct RationalPoint {
  IntegerVector numerator{};
  Integer denominator = 1;
  std::vector<Integer> weights;  // of the points, all > 0; their sum is 1 only after division by it
};

// Reduces one to four points to those whose weights in the nearest point are positive, and returns
// that point.
RationalPoint reduce_to_nearest(std::vector<IntegerVector>& points);

}  // namespace touchstone::oracle
