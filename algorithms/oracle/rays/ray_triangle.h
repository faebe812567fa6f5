// Part of the oracle: a ray against a triangle in integers.
#pragma once

#include <array>
#include <optional>

#include "algorithms/core/pose.h"
#include "algorithms/core/vec.h"
#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// A point of a ray in a triangle.
struct RayPoint {
  Integer top, bottom;  // t = top / bottom, with top >= 0 and bottom > 0
  double u, v;          // weights of the second and the third vertex, rounded once
};

// The first point of the ray from `origin` on that is in the closed triangle, which may be a segment or
// a point. Every number is finite and taken literally; the direction is not zero.
std::optional<RayPoint> first_point(const Vec3d& origin, const Vec3d& direction,
                                    const std::array<Vec3d, 3>& triangle);

// The same for a triangle whose vertices are in the coordinates of a body with this pose.
std::optional<RayPoint> first_point(const Vec3d& origin, const Vec3d& direction,
                                    const std::array<Vec3d, 3>& triangle, const Pose& pose);

// The sign of the first point's t less the second's, or less x.
int compare_t(const RayPoint& first, const RayPoint& second);
int compare_t(const RayPoint& point, double x);

// top / bottom as a double, off by at most one unit in its last place. bottom > 0.
double quotient(const Integer& top, const Integer& bottom);

}  // namespace touchstone::oracle
