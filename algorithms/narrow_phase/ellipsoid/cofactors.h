// Part of ellipsoid: a symmetric 3x3 matrix by its cofactors, for solving and a bound on its
// eigenvalues. Includes core only.
#pragma once

#include <cmath>
#include <limits>

#include "algorithms/core/vec.h"

namespace touchstone {

template <class Scalar>
struct Cofactors {
  Vec3<Scalar> x, y, z;  // rows, which are equal to the columns
  Scalar determinant;

  explicit Cofactors(const Mat3<Scalar>& m)
      : x(m.col(1).cross(m.col(2))),
        y(m.col(2).cross(m.col(0))),
        z(m.col(0).cross(m.col(1))),
        determinant(m.col(0).dot(x)) {}

  Vec3<Scalar> solve(const Vec3<Scalar>& c) const {
    return Vec3<Scalar>{x.dot(c), y.dot(c), z.dot(c)} / determinant;
  }
  // A lower bound on the eigenvalues of a matrix of this trace that has no negative one; it holds
  // whatever rounding did to the cofactors.
  Scalar least(Scalar trace) const {
    const Scalar lost = 4 * std::numeric_limits<Scalar>::epsilon() * trace * trace;
    const Scalar norm = std::sqrt(x.squaredNorm() + y.squaredNorm() + z.squaredNorm());
    const Scalar surely = determinant - lost * trace;
    return surely > 0 ? surely / (norm + lost) : Scalar{0};
  }
};

}  // namespace touchstone
