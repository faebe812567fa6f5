// Vectors and poses in Bullet's types. Only for this room, and where Bullet is built.
#pragma once

#include <LinearMath/btTransform.h>

#include "algorithms/core/pose.h"

namespace touchstone::simulate {

inline btVector3 to_bullet(const Vec3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
inline btTransform to_bullet(const Pose& pose) {
  const auto entry = [&](int i, int k) { return static_cast<btScalar>(pose.rotation(i, k)); };
  const btMatrix3x3 rotation(entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1),
                             entry(1, 2), entry(2, 0), entry(2, 1), entry(2, 2));
  return btTransform(rotation, to_bullet(pose.translation));
}
inline Vec3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace touchstone::simulate
