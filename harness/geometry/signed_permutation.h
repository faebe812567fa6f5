// The 24 rotations that are exact in binary numbers: signed permutations of the axes. Used by
// harness/check.
#pragma once

#include <array>
#include <span>
#include <string>

#include "algorithms/core/vec.h"

namespace touchstone::geometry {

struct SignedPermutation {
  std::array<int, 3> from = {0, 1, 2};     // component i of the image is that of axis from[i],
  std::array<double, 3> sign = {1, 1, 1};  // times this

  Vec3d operator()(const Vec3d& v) const { return {image(v, 0), image(v, 1), image(v, 2)}; }
  // Exact, and never gives a negative zero.
  Mat3d operator()(const Mat3d& m) const;
  Mat3d matrix() const { return (*this)(Mat3d(Mat3d::Identity())); }
  SignedPermutation inverse() const;
  // A name such as "+y-x+z": the axes that supply x, y and z.
  std::string name() const;

 private:
  double image(const Vec3d& v, std::size_t i) const {
    const double x = v[from[i]];
    return sign[i] > 0 ? x : 0.0 - x;
  }
};

// All permutations of determinant 1; the identity is first.
std::span<const SignedPermutation> signed_permutations();

}  // namespace touchstone::geometry
