// How far a matrix is from a rotation.
#pragma once

#include <algorithm>
#include <cmath>

#include "algorithms/core/pose.h"

namespace touchstone {

// By how much the columns of a matrix fail to be orthonormal: the greatest error of their products. The entries are finite.
inline double orthonormal_error(const Mat3d& m) {
  const auto a = m.col(0), b = m.col(1), c = m.col(2);
  return std::max({std::abs(a.squaredNorm() - 1), std::abs(b.squaredNorm() - 1),
                   std::abs(c.squaredNorm() - 1), std::abs(a.dot(b)), std::abs(a.dot(c)),
                   std::abs(b.dot(c))});
}

}  // namespace touchstone
