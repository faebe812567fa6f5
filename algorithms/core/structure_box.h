// A region by which a broad phase finds pairs, for pictures. Everything may include this.
#pragma once

#include <cstdint>

#include "algorithms/core/aabb.h"

namespace touchstone {

// A cell of a grid, a node of a tree, a fattened box, or an interval of a sorted axis: flat on the
// other axes, where it lies at the least corner of the scene. In world coordinates (metres).
struct StructureBox {
  Aabb box;
  // The depth of a node, or the rank of a cell among the sizes in use. 0 is the coarsest: the root,
  // or the largest cells. Intervals are all at 0.
  std::uint32_t level = 0;

  friend constexpr bool operator==(const StructureBox&, const StructureBox&) = default;
};

}  // namespace touchstone
