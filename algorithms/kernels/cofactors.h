// A symmetric matrix of three rows by its cofactors.
#pragma once

#include <algorithm>
#include <cmath>

#include "algorithms/core/vec.h"

namespace touchstone {

template <class Scalar>
struct Cofactors {
  Vec3<Scalar> x, y, z;  // its rows are its columns
  Scalar determinant;

  explicit Cofactors(const Mat3<Scalar>& m)
      : x(m.col(1).cross(m.col(2))),
        y(m.col(2).cross(m.col(0))),
        z(m.col(0).cross(m.col(1))),
        determinant(m.col(0).dot(x)) {}

  Vec3<Scalar> solve(const Vec3<Scalar>& c) const {
    return Vec3<Scalar>{x.dot(c), y.dot(c), z.dot(c)} / determinant;
  }
  // No eigenvalue of a matrix that has none below zero is less.
  Scalar least() const {
    const Scalar norm = std::sqrt(x.squaredNorm() + y.squaredNorm() + z.squaredNorm());
    return norm > 0 ? std::max(determinant, Scalar{0}) / norm : Scalar{0};
  }
};

}  // namespace touchstone
