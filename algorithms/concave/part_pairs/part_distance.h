// Part of part-pairs: the distance of two bodies that share no point.
#pragma once

#include <span>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/concave/part_pairs/convex_pairs.h"
#include "algorithms/concave/part_pairs/mesh_tree.h"
#include "algorithms/concave_phase.h"
#include "algorithms/kernels/bvh/wide_nearest.h"

namespace touchstone {

class PartDistance {
 public:
  // `tolerance` is that of ConcaveSettings.
  explicit PartDistance(std::optional<double> tolerance) : tolerance_(tolerance.value_or(0)) {}

  // The bodies and trees stay alive and unchanged. Trees of bodies that are not among these are built
  // with the first query.
  void bind(std::span<const BoundBody> bodies, const MeshTrees& given);

  // The boxes of the body have changed.
  void refit(std::uint32_t body);

  // Writes the distance, its bounds, the points and the normal. `lower` and `upper` are certified:
  // they cover all rounding; between convex parts they are those of the narrow phase. Where they are further apart
  // than 1e-9 of the distance, 1e-12 of the bodies' coordinates and the tolerance the status is not_converged. Nothing
  // is written if a body has no parts.
  void measure(const PlacedConcave& a, const PlacedConcave& b, ConvexPairs& convex_pairs,
               Outcome& outcome);

 private:
  const MeshTree& tree_of(std::uint32_t body);

  double tolerance_;
  std::span<const BoundBody> bodies_;
  const MeshTrees* given_ = nullptr;
  MeshTrees trees_;
  WideNearest nearest_;
};

}  // namespace touchstone
