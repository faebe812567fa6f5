// How far a matrix is from a rotation.
#pragma once

#include <algorithm>
#include <cmath>

#include "algorithms/core/vec.h"

namespace touchstone {

// The greatest sum of a row's magnitudes of M^T M - I, in doubles. No vector becomes longer by M than by the root of
// 1 + skew, nor shorter than by that of 1 - skew. NaN if a coefficient is.
inline double skew_of(const Mat3d& m) {
  const auto off = [&](int i, int k) {
    return std::abs(m(0, i) * m(0, k) + m(1, i) * m(1, k) + m(2, i) * m(2, k) - (i == k ? 1 : 0));
  };
  const double xy = off(0, 1), xz = off(0, 2), yz = off(1, 2);
  const double x = off(0, 0) + xy + xz, y = off(1, 1) + xy + yz, z = off(2, 2) + xz + yz;
  const double greatest = x > y ? x : y;
  return (z > greatest ? z : greatest) + (x + y + z - (x + y + z));
}

// Bounds the sum of the magnitudes of each row and column of a matrix whose skew is at most 1e-6: the root of 3, and a
// little more.
constexpr double greatest_row_of_turn = 1.7321;

}  // namespace touchstone
