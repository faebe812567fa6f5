// The closest point of a triangle, in doubles.
#pragma once

#include <array>

#include "algorithms/core/vec.h"

namespace touchstone {

// The point of the closed triangle that is nearest to p. Every point that it considers is one of the triangle,
// but for rounding. Of a triangle so thin that its normal is nothing but rounding, the point inside may be
// any, and an edge's is near enough. The triangle may be a segment or a point.
Vec3d closest_of(const Vec3d& p, const std::array<Vec3d, 3>& corners);

}  // namespace touchstone
