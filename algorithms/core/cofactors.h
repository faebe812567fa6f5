// The matrix of a matrix's cofactors: its inverse transpose times its determinant. It turns normals
// of planes as the matrix turns points, whatever the matrix is.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

template <class Scalar>
Mat3<Scalar> cofactor_matrix(const Mat3<Scalar>& m) {
  Mat3<Scalar> cofactors;
  for (int k = 0; k < 3; ++k) cofactors.col(k) = m.col((k + 1) % 3).cross(m.col((k + 2) % 3));
  return cofactors;
}

}  // namespace touchstone
