// The length of a vector at every scale.
#pragma once

#include <cmath>

#include "algorithms/core/vec.h"

namespace touchstone {

// Unlike norm(), whose squares have no digits below about 1e-154 and overflow above, so that it may be 0 or infinite.
inline double length_of(const Vec3d& v) {
  const double square = v.squaredNorm();
  return square > 0x1p-900 && square < 0x1p1000 ? std::sqrt(square) : v.stableNorm();
}

}  // namespace touchstone
