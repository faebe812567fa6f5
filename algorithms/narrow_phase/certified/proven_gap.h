// Bounds on the signed distance of two bounded bodies that rounding cannot break.
//
// A direction proves how far apart two bodies are at least, points of their cores how far at most.
// Both are taken here from the shapes' and poses' own numbers, in long double, with a bound on each
// rounding; where a long double has no wider range than a double, nothing is proven.
// Paper: Wilkinson, "Rounding Errors in Algebraic Processes", 1963 (the bounds); Cameron,
// "Enhancing GJK", ICRA 1997 (both bounds from one search).
#pragma once

#include "algorithms/core/pose.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/narrow_phase/certified/proven_support.h"

namespace touchstone {

class GapProver {
 public:
  // `normal` (unit, from a to b) proves the lower bound; the points of the simplex, which are of
  // this pair of the same bodies, with their weights the upper one; it may be empty. The closer its
  // plane is to the normal's, the better the bounds.
  ProvenGap between(const ProvenShape& a, const Pose& pose_a, const ProvenShape& b,
                    const Pose& pose_b, const SupportPair<double>& pair,
                    const Simplex<double>& simplex, const Vec3d& normal);

 private:
  std::vector<std::uint32_t> furthest_a_, furthest_b_;  // hulls: vertices that may be
  std::vector<double> values_;
};

}  // namespace touchstone
