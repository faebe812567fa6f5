// Part of certified: bounds on the signed distance of two bounded bodies that rounding cannot
// break. Includes core, kernels and this folder.
//
// A direction gives a lower bound on the distance, points of the cores an upper bound. Both are
// computed here in long double from the numbers of shapes and poses, with a bound on each rounding.
// If long double has no wider range than double, nothing is proven.
// Paper:   Wilkinson, "Rounding Errors in Algebraic Processes", 1963 (the bounds); Cameron,
//          "Enhancing GJK", ICRA 1997 (both bounds from one search).
#pragma once

#include "algorithms/core/pose.h"
#include "algorithms/kernels/epa/epa_hull.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/narrow_phase/certified/support_bounds.h"

namespace touchstone {

struct WidePair;

class DistanceBounder {
 public:
  // `normal` (unit, from a to b) proves the lower bound. The points of the simplex with their
  // weights prove the upper one; they must be points of this pair, and there may be none. The
  // closer the simplex's plane is to the normal's, the better the bounds.
  DistanceBounds between(const BoundedShape& a, const Pose& pose_a, const BoundedShape& b,
                         const Pose& pose_b, const SupportPair<double>& pair,
                         const Simplex<double>& simplex, const Vec3d& normal);

  // Bounds the signed distance of two polytopes without radius that overlap. `surface` is closed,
  // its corners are support points of this pair, and the origin is behind each of its faces: then
  // the difference holds a ball around the origin that reaches to the nearest face. `normal` (unit,
  // from a to b) is that face's; the support along it bounds the depth from above.
  DistanceBounds inside(const BoundedShape& a, const Pose& pose_a, const BoundedShape& b,
                        const Pose& pose_b, const SupportPair<double>& pair,
                        const EpaHull<double>& surface, const Vec3d& normal);

 private:
  double bound_along(const WidePair& pair, const Wide3& n);

  std::vector<std::uint32_t> furthest_a_, furthest_b_;  // hulls: vertices that may be furthest
  Eigen::ArrayXd values_;
};

}  // namespace touchstone
