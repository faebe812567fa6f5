// The least ball around points. Used by harness/proxies.
#pragma once

#include <span>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone::geometry {

struct Ball {
  Vec3d centre = Vec3d::Zero();
  double radius = 0;  // metres; correct to rounding in either direction
};

// Requires at least one point. Method: the least ball of a few points grows by the point farthest
// outside it and drops those that it does not need (the simplex-like exchange of Gaertner, "Fast
// and robust smallest enclosing balls", ESA 1999). The small problem is solved over all subsets.
Ball least_ball(std::span<const Vec3d> points);

}  // namespace touchstone::geometry
