// The loop over a batch that the separating axis tests share: prepared boxes and hulls, against
// each other or against a half-space, which has only its own axis. Used by sat and sat-faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/kernels/minkowski/halfspace.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/sat/separating_axis.h"

namespace touchstone {

// Returns true if both bodies are boxes or hulls, or b is a half-space. It is the `supports` of
// both contracts' entries.
inline bool are_polytopes(ShapeKind a, ShapeKind b, Task) {
  const auto bounded = [](ShapeKind kind) {
    return kind == ShapeKind::box || kind == ShapeKind::hull;
  };
  return bounded(a) && (bounded(b) || b == ShapeKind::halfspace);
}

template <class Scalar>
class PolytopeShapes {
 public:
  void bind(std::span<const Shape> shapes) {
    polytopes_ = make_polytopes<Scalar>(shapes);
    support_shapes_ = make_support_shapes<Scalar>(shapes);
  }

  // Solves a batch of the narrow phase's contract: answers pairs with a half-space, and calls
  // solve_pair(const PolytopePair<Scalar>&, i) for each other pair, where i is its place in the
  // batch.
  template <class Batch, class SolvePair>
  void solve(Task task, const Batch& batch, std::span<Outcome> outcomes,
             const SolvePair& solve_pair) const {
    if (batch.kind_b == ShapeKind::halfspace) {
      solve_halfspace_batch<Scalar>(support_shapes_, batch.pairs, task, outcomes);
      return;
    }
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
      const std::uint32_t a = batch.pairs.shape_of[first], b = batch.pairs.shape_of[second];
      solve_pair(PolytopePair<Scalar>(polytopes_[a], batch.pairs.poses[first], polytopes_[b],
                                      batch.pairs.poses[second]),
                 i);
    }
  }

 private:
  std::vector<Polytope<Scalar>> polytopes_;
  std::vector<SupportShape<Scalar>> support_shapes_;
};

}  // namespace touchstone
