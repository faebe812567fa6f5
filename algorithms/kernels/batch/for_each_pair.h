// The loop over a batch, for algorithms that solve one pair at a time. Used by gjk, gjk-templated,
// mpr, mpr-refined, certified and smooth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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

// Runs that loop over the support shapes of a narrow phase's batch. It answers pairs whose second
// body is a half-space, and calls solve_pair for pairs of bounded bodies alone.
template <class Scalar, class Batch, class SolvePair>
void for_each_bounded_pair(Task task, const Batch& batch,
                           const std::vector<SupportShape<Scalar>>& shapes,
                           ShapePrefetch<Scalar>& ahead, bool far_too, std::span<Outcome> outcomes,
                           const SolvePair& solve_pair) {
  if (batch.kind_b != ShapeKind::halfspace) {
    for_each_pair(batch.pairs, shapes, ahead, far_too, solve_pair);
    return;
  }
  if (batch.kind_a != ShapeKind::halfspace) {
    solve_halfspace_batch<Scalar>(shapes, batch.pairs, task, outcomes);
    return;
  }
  for_each_pair(batch.pairs, shapes, ahead, far_too, [&](std::size_t i, const auto&... bodies) {
    solve_halfspaces(bodies..., task, outcomes[i]);
  });
}

// Does the same for pair i alone, and prefetches nothing.
template <class Scalar, class Batch, class SolvePair>
void for_bounded_pair(Task task, const Batch& batch, std::size_t i,
                      const std::vector<SupportShape<Scalar>>& shapes, Outcome& outcome,
                      const SolvePair& solve_pair) {
  const BodyPairs& pairs = batch.pairs;
  const std::uint32_t a = pairs.first[i], b = pairs.second[i];
  const SupportShape<Scalar>&shape_a = shapes[pairs.shape_of[a]],
        &shape_b = shapes[pairs.shape_of[b]];
  if (batch.kind_b != ShapeKind::halfspace) {
    solve_pair(i, shape_a, pairs.poses[a], shape_b, pairs.poses[b]);
    return;
  }
  const auto solve =
      batch.kind_a == batch.kind_b ? solve_halfspaces<Scalar> : solve_halfspace<Scalar>;
  solve(shape_a, pairs.poses[a], shape_b, pairs.poses[b], task, outcome);
}

}  // namespace touchstone
