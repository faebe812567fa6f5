// What a walk found of a ray, before its numbers are calculated.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "algorithms/kernels/rays/ray_block.h"
#include "algorithms/kernels/rays/ray_query.h"

namespace touchstone::ray_tree {

// A triangle, by its place in the tree.
struct FoundHit {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t leaf = none, lane = 0;

  bool is_found() const { return leaf != none; }
  bool operator==(const FoundHit&) const = default;
};

// A ray for which floats do not tell what it hits. The first question makes the query.
class DoubtfulRay {
 public:
  DoubtfulRay(const RayMesh& mesh, const RayBlock& block, std::size_t ray)
      : mesh_(mesh), block_(block), ray_(ray) {}

  // Offers the query what was found for certain and another triangle. Returns true if the walk may end.
  // Otherwise lowers tau_end to what matters still.
  bool offer(const FoundHit& found, const FoundHit& other, RayTask task, float& tau_end);

  bool is_asked() const { return query_.has_value(); }
  // The first of all that was offered and of what was found; only if it was asked.
  RayHit hit(const FoundHit& found);

 private:
  bool offer(const FoundHit& one);

  const RayMesh& mesh_;
  const RayBlock& block_;
  std::size_t ray_;
  std::optional<RayQuery> query_;
  FoundHit offered_;  // of those that were found, the last that was offered
};

}  // namespace touchstone::ray_tree
