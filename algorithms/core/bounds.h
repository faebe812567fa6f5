// The tight and loose boxes of bodies, rounded outward, and their support points. Used by peers and by the
// rooms families, scene, proxies, check, grade, trade and cells.
#pragma once

#include "algorithms/core/aabb.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// The two boxes below contain every point of the body, whatever the rounding: extents are computed
// in double, widened by a bound on the error of that computation, and rounded outward to float. The
// box of a half-space is bounded only on an axis along which its normal lies.

// Returns the least such box, up to rounding.
Aabb tight_box(const Shape& shape, const Pose& pose);

// Returns a cube about the body's origin whose size does not depend on the body's rotation. `reach`
// is computed once, and the box then follows the body: larger and cheaper than the tight box.
Aabb loose_box(double reach, const Vec3d& translation);

// Returns the greatest distance of a body's points from its origin (metres), rounded up; infinite
// for a half-space. `rotation` matters only as far as it is not orthonormal.
double loose_reach(const Shape& shape, const Mat3d& rotation);

// Returns the point of the body that is furthest in a direction, in the world as the direction is, which has
// any length but 0; of several points one. It is rounded as doubles are. A half-space has none; the
// origin of its body stands for it.
Vec3d support_point(const Shape& shape, const Pose& pose, const Vec3d& direction);

}  // namespace touchstone
