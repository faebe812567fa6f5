// Part of dynamic-bvh: the loops of bvh16.h. bvh16.cpp includes them once for each level of vector
// instructions, inside that level's namespace.

// Writes the ids of these nodes' children that overlap the box, and returns their number.
TOUCHSTONE_TARGET std::size_t descend(const Columns& boxes, const Aabb& box,
                                      const std::uint32_t* nodes, std::size_t count,
                                      std::uint32_t* children) {
  const Row row = row_of(box);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = std::size_t{nodes[i]} * Bvh16::fan;
    found += Lanes::compress(overlaps16(row, boxes, first), boxes.ids + first, children + found);
  }
  return found;
}

// The bounds of the 16 boxes from this place on.
TOUCHSTONE_TARGET Aabb bounds16(const Columns& boxes, std::size_t first) {
  Aabb bounds{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bounds.min[axis] = Lanes::reduce_min16(boxes.min[axis] + first);
    bounds.max[axis] = Lanes::reduce_max16(boxes.max[axis] + first);
  }
  return bounds;
}

// The surfaces of 16 boxes, and their growth when each is united with another box. The compiler
// vectorises this.
TOUCHSTONE_TARGET void surfaces16(const Columns& boxes, std::size_t first, const Aabb& other,
                                  double* growths, double* surfaces) {
  for (std::size_t i = 0; i < Bvh16::fan; ++i) {
    std::array<double, 3> own, sum;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float low = boxes.min[axis][first + i];
      const float high = boxes.max[axis][first + i];
      own[axis] = double{high} - low;
      sum[axis] = double{high > other.max[axis] ? high : other.max[axis]} -
                  (low < other.min[axis] ? low : other.min[axis]);
    }
    surfaces[i] = surface(own[0], own[1], own[2]);
    growths[i] = surface(sum[0], sum[1], sum[2]) - surfaces[i];
  }
}
