// The loop over a batch, for algorithms that solve one pair at a time. Used by gjk, gjk-templated,
// mpr, mpr-refined and certified.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"
#include "algorithms/kernels/batch/shape_prefetch.h"
#include "algorithms/kernels/minkowski/halfspace.h"

namespace touchstone {

// Calls solve_pair(i, shape_a, pose_a, shape_b, pose_b) for each pair, in order, while `ahead`
// prefetches the next ones. `ahead` is bound to `shapes`. ShapePrefetch::begin explains `far_too`.
template <class Scalar, class Item, class SolvePair>
void for_each_pair(const BodyPairs& pairs, const std::vector<Item>& shapes,
                   ShapePrefetch<Scalar>& ahead, bool far_too, const SolvePair& solve_pair) {
  ahead.begin(pairs, far_too);
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    ahead.before(i);
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    solve_pair(i, shapes[pairs.shape_of[a]], pairs.poses[a], shapes[pairs.shape_of[b]],
               pairs.poses[b]);
  }
}

// Solves a pair whose second body is a half-space; returns false for two bounded bodies.
template <class Scalar>
bool solve_if_halfspace(ShapeKind kind_a, ShapeKind kind_b, const SupportShape<Scalar>& a,
                        const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b,
                        Task task, Outcome& outcome) {
  if (kind_b != ShapeKind::halfspace) return false;
  const auto solve = kind_a == kind_b ? solve_halfspaces<Scalar> : solve_halfspace<Scalar>;
  solve(a, pose_a, b, pose_b, task, outcome);
  return true;
}

}  // namespace touchstone
