// Vectors and matrices of the field's size, from Eigen.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace touchstone {

template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Mat3 = Eigen::Matrix<Scalar, 3, 3>;

using Vec3d = Vec3<double>;
using Mat3d = Mat3<double>;

}  // namespace touchstone
