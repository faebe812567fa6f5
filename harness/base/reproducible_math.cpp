// Finds rotations.
#include "harness/base/reproducible_math.h"

#include <cmath>

namespace touchstone::base {
namespace {

// The reflection in the plane across a unit vector.
Mat3d reflection(const Vec3d& normal) {
  return Mat3d::Identity() - 2 * normal * normal.transpose();
}

}  // namespace

Mat3d rotation_between(const Vec3d& from, const Vec3d& to) {
  const Vec3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  if (cosine < -1 + 1e-12) {
    // Nearly half a turn, whose axis a cross product does not give. The first reflection leaves a where it is, the
    // second takes it to b.
    return reflection((a - b).normalized()) * reflection(a.unitOrthogonal());
  }
  const double root = std::sqrt((1 + cosine) * 2);
  const Vec3d axis = a.cross(b) * (1 / root);
  return Eigen::Quaterniond(root * 0.5, axis.x(), axis.y(), axis.z()).toRotationMatrix();
}

}  // namespace touchstone::base
