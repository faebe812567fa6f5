// The rotation that takes one direction to another.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone::base {

// Returns the rotation by the smallest angle that takes `from` to the direction of `to`; where they are opposite it is
// one of many. The vectors may have any length but zero. Rounding is in proportion to 1 / (1 + cosine), but for the last
// 1e-12 before opposites, where it is small. Eigen's function of that kind, whose bits these are elsewhere, falls back on
// a singular value decomposition, which takes ten seconds to compile.
Mat3d rotation_between(const Vec3d& from, const Vec3d& to);

}  // namespace touchstone::base
