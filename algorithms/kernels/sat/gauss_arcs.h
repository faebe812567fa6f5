// The edges of a polytope as arcs on the Gauss map. Finds the arcs that may cross the arc of
// another body's edge, many at a time, so that few edge pairs need more careful tests. Used by sat.
// Paper:   Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

// An edge whose outward normals form the arc from `left` to `right`. The edge has the direction of
// left x right; all have about unit length.
struct GaussArc {
  Vec3<float> direction, left, right;
};

// Sixteen arcs. The rows are x, y and z of the direction, then of left and right.
struct GaussBlock {
  static constexpr std::size_t size = 16;
  alignas(64) std::array<std::array<float, size>, 9> rows{};
};

// Floats suffice to exclude arcs that certainly do not cross.
class GaussArcs {
 public:
  void add(const GaussArc& arc);
  std::size_t size() const { return size_; }

  // Appends the indices of the arcs, ascending, that may cross the arc of an edge of another body,
  // whose normals are opposite to this one's: all arcs that cross, and those that rounding leaves
  // open. `arc` is that edge's, transformed so that its direction can be multiplied with stored
  // normals of this body, and its normals with stored directions. The result is equal at every
  // level of vector instructions.
  void list_crossing(const GaussArc& arc, std::vector<std::uint32_t>& crossing) const;

 private:
  std::vector<GaussBlock> blocks_;
  std::size_t size_ = 0;
};

}  // namespace touchstone
