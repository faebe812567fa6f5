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

// Sixteen of them: direction, left and right; x, y and z of each.
struct GaussBlock {
  static constexpr std::size_t size = 16;
  alignas(64) std::array<std::array<float, size>, 9> rows{};
};

// Floats are enough to leave out what certainly does not cross.
class GaussArcs {
 public:
  void add(const GaussArc& arc);
  std::size_t size() const { return size_; }

  // Appends the numbers of the arcs, ascending, that may cross the arc of an edge of a body in
  // front of this one, whose normals are then against that one's: all that do, and those that
  // rounding leaves open. `arc` is that edge's, turned so that its direction can be multiplied with
  // normals of this body as they are stored, and its normals with directions. The same at every
  // level of vector instructions.
  void list_crossing(const GaussArc& arc, std::vector<std::uint32_t>& crossing) const;

 private:
  std::vector<GaussBlock> blocks_;
  std::size_t size_ = 0;
};

}  // namespace touchstone
