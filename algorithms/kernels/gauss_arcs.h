// The edges of a polytope as arcs on the Gauss map, and which of them may cross the arc of another
// body's edge: many at a time, so that few edge pairs are left for more careful tests.
// Paper: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

// An edge whose outward normals are the arc from `left` to `right`, along the direction of
// left x right; all of about unit length.
struct GaussArc {
  Vec3<float> direction, left, right;
};

// Floats are enough to leave out what certainly does not cross.
class GaussArcs {
 public:
  void add(const GaussArc& arc);
  std::size_t size() const { return size_; }

  // Appends the numbers of the arcs that may cross, reversed as those of a body behind are, the arc
  // of another edge: all that do, and those that rounding leaves open. `direction`, `left` and
  // `right` are that edge's, each as the linear form or vector that it is paired with: for arc i,
  // `direction` with normals, `left` and `right` with directions.
  void list_crossing(const GaussArc& arc, std::vector<std::uint32_t>& crossing) const;

 private:
  static constexpr std::size_t block = 16;
  struct Block {
    // direction, left and right; x, y and z
    alignas(64) std::array<std::array<float, block>, 9> rows{};
  };

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

}  // namespace touchstone
