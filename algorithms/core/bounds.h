// Boxes of bodies: exact extents, rounded outward.
#pragma once

#include "algorithms/core/aabb.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Both hold every point of the body, whatever the rounding: the extents are computed in double,
// widened by a bound on the error of that computation, and rounded outward to float. A half-space
// has the extents of its kind where its normal lies along an axis, and is infinite otherwise.

// The least such box, up to rounding.
Aabb tight_box(const Shape& shape, const Pose& pose);

// A cube about the body's origin whose size does not depend on how the body is turned: `reach` is
// computed once, and the box then follows the body. Larger, and cheaper: a trade to be measured.
Aabb loose_box(double reach, const Vec3d& translation);

// The greatest distance of a body's points from its origin (metres), rounded up; infinite for a
// half-space. `rotation` counts only as far as it is not orthonormal.
double loose_reach(const Shape& shape, const Mat3d& rotation);

}  // namespace touchstone
