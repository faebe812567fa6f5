// Bounds on the signed distance of two bodies that rounding cannot break.
//
// A direction proves how far apart two bodies are at least, points of their cores how far at most.
// Both are taken here from the shapes' and poses' own numbers, in long double, with a bound on each
// rounding; where a long double is no wider in its range than a double, nothing is proven.
// Paper: Wilkinson, "Rounding Errors in Algebraic Processes", 1963 (the bounds); Cameron,
// "Enhancing GJK", ICRA 1997 (both bounds from one search).
#pragma once

#include <limits>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/kernels/simplex.h"

namespace touchstone {

// What is proven: lower <= signed distance <= upper (metres). Infinite where nothing is.
struct ProvenGap {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

// A shape, and the box around its core that the bounds are relative to. The shape stays alive.
struct ProvenShape {
  explicit ProvenShape(const Shape& s);

  const Shape* shape;
  Vec3d reach;  // the greatest magnitude of each body coordinate in the core, metres
};

class GapProver {
 public:
  // Neither is a half-space. `direction` (unit, from a to b) proves the lower bound; the points of
  // the simplex, which are of this pair of the same bodies, with their weights the upper one; it
  // may be empty. The closer the simplex's plane is to the direction's, the better the bound.
  ProvenGap between(const ProvenShape& a, const Pose& pose_a, const ProvenShape& b,
                    const Pose& pose_b, const Vec3d& direction, const SupportPair<double>& pair,
                    const Simplex<double>& simplex, const Vec3d& centre_a, const Vec3d& centre_b);

  // Body b is a half-space, body a is not; `normal` becomes its outward normal in the world.
  ProvenGap above_plane(const ProvenShape& a, const Pose& pose_a, const ProvenShape& b,
                        const Pose& pose_b, Vec3d& normal);

 private:
  std::vector<std::uint32_t> furthest_a_, furthest_b_;  // hulls: vertices that may be
  std::vector<double> values_;
};

}  // namespace touchstone
