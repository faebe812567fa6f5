// Part of the oracle: a ray against a half-space in integers.
#pragma once

#include <optional>

#include "algorithms/oracle/rays/ray_triangle.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// True if the body's matrix has an inverse, so that its image has points outside.
bool has_plane(const Body& half_space);

// The first point of the ray that is in the closed half-space, whose matrix has an inverse. Every number is
// finite and taken literally; the direction is not zero. u and v mean nothing.
std::optional<RayPoint> first_point_below(const Vec3d& origin, const Vec3d& direction,
                                          const Body& half_space);

}  // namespace touchstone::oracle
