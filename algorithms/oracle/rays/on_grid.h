// Part of the oracle: points in doubles as integers over a power of two.
#pragma once

#include <algorithm>

#include "algorithms/core/vec.h"
#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {

// The least exponent of the coordinates as dyadic numbers.
inline int least_exponent(const Vec3d& v) {
  return std::min({dyadic(v[0]).exponent, dyadic(v[1]).exponent, dyadic(v[2]).exponent});
}

// The coordinates over 2^exponent, which is at most their least.
inline IntegerVector on_grid(const Vec3d& v, int exponent) {
  return {dyadic(v[0]).over_power(exponent), dyadic(v[1]).over_power(exponent),
          dyadic(v[2]).over_power(exponent)};
}

}  // namespace touchstone::oracle
