// The least ball around points, and the greatest copy of a convex body inside a polytope. Used by
// harness/proxies.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "algorithms/core/vec.h"
#include "harness/geometry/polyhedron.h"

namespace touchstone::geometry {

struct Ball {
  Vec3d centre = Vec3d::Zero();
  double radius = 0;  // metres; correct to rounding in either direction
};

// Requires at least one point. Method: the least ball of a few points grows by the point farthest
// outside it and drops those that it does not need (the simplex-like exchange of Gaertner, "Fast
// and robust smallest enclosing balls", ESA 1999). The small problem is solved over all subsets.
Ball least_ball(std::span<const Vec3d> points);

struct Copy {
  Vec3d centre = Vec3d::Zero();
  double scale = 0;  // negative if there is no copy
};

// Returns the greatest scale, and a centre, for which centre + scale * K is in every plane's
// half-space (unit normals), within `bound` of `start`. `support` is the support function of K
// around its centre. The result is correct to rounding (relative to the bound). Method: Seidel,
// "Small-dimensional linear programming and convex hulls made easy", Discrete & Computational
// Geometry 6, 1991.
Copy greatest_copy(std::span<const Plane> planes,
                   const std::function<double(const Vec3d&)>& support, const Vec3d& start,
                   double bound);

// The least t such that some (x, y) with x, y >= 0 and x + y <= 1 has a[i] . (x, y, 1) <= t for all
// i.
double least_maximum(std::span<const Vec3d> a);

}  // namespace touchstone::geometry
