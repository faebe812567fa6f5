// The rotation that takes one direction to another, by the shortest way. Eigen's function of that
// kind falls back on a singular value decomposition, which takes ten seconds to compile.
#pragma once

#include <cmath>

#include "algorithms/core/vec.h"

namespace touchstone {

// The vectors may have any length but zero.
inline Mat3d rotation_between(const Vec3d& from, const Vec3d& to) {
  const Vec3d a = from.normalized(), b = to.normalized();
  const double cosine = a.dot(b);
  if (cosine < -1 + 1e-12) {  // half a turn about any axis across
    return Eigen::AngleAxisd(M_PI, a.unitOrthogonal()).toRotationMatrix();
  }
  const double root = std::sqrt(2 * (1 + cosine));
  const Vec3d axis = a.cross(b) / root;
  return Eigen::Quaterniond(root / 2, axis.x(), axis.y(), axis.z()).toRotationMatrix();
}

}  // namespace touchstone
