// Boxes for the pictures of a broad phase, made from what it holds for its search. Used by the
// sweeps, by uniform-grid, hierarchical-grid and loose-octree, and by the room bvh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/structure_box.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// Returns the boxes in their order.
std::vector<Aabb> list_boxes(const AabbSoA& boxes);

// Returns the bounds of all boxes; empty if there are none.
Aabb bounds_of(std::span<const Aabb> boxes);

// Returns each box's interval on the axis, at the least corner of all boxes on the other two. No
// box is empty.
std::vector<StructureBox> intervals_of(std::span<const Aabb> boxes, std::size_t axis);

}  // namespace touchstone
