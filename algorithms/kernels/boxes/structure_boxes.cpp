// Boxes for the pictures of a broad phase.
#include "algorithms/kernels/boxes/structure_boxes.h"

#include <algorithm>

namespace touchstone {

std::vector<Aabb> list_boxes(const AabbSoA& boxes) {
  std::vector<Aabb> list(boxes.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = boxes.box(i);
  return list;
}

Aabb bounds_of(std::span<const Aabb> boxes) {
  Aabb bounds = Aabb::empty();
  for (const Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::min(bounds.min[axis], box.min[axis]);
      bounds.max[axis] = std::max(bounds.max[axis], box.max[axis]);
    }
  }
  return bounds;
}

std::vector<StructureBox> intervals_of(std::span<const Aabb> boxes, std::size_t axis) {
  const std::array<float, 3> corner = bounds_of(boxes).min;
  std::vector<StructureBox> intervals;
  for (const Aabb& box : boxes) {
    Aabb interval{corner, corner};
    interval.min[axis] = box.min[axis];
    interval.max[axis] = box.max[axis];
    intervals.push_back({interval});
  }
  return intervals;
}

}  // namespace touchstone
