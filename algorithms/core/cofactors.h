// The matrix of a matrix's cofactors: its inverse transpose times its determinant. It turns normals
// of planes as the matrix turns points, whatever the matrix is.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// It is inlined, since a call costs sat an eighth of its instructions for pairs far apart.
template <class Scalar>
[[gnu::always_inline]] inline Mat3<Scalar> cofactor_matrix(const Mat3<Scalar>& m) {
  Mat3<Scalar> cofactors;
  cofactors.col(0) = m.col(1).cross(m.col(2));
  cofactors.col(1) = m.col(2).cross(m.col(0));
  cofactors.col(2) = m.col(0).cross(m.col(1));
  return cofactors;
}

}  // namespace touchstone
