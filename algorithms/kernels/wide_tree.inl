// The loops of wide_tree.h. Included by wide_tree.cpp once for each level of vector instructions,
// inside that level's namespace: `Lanes` are its vectors, TOUCHSTONE_TARGET its attribute.

TOUCHSTONE_TARGET inline Row row_of(const Aabb& box) {
  Row row;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row.min[axis] = Lanes::broadcast(box.min[axis]);
    row.max[axis] = Lanes::broadcast(box.max[axis]);
  }
  return row;
}

// The ids of the children of these nodes that overlap the box; how many.
TOUCHSTONE_TARGET std::size_t descend(const Columns& boxes, const Aabb& box,
                                      const std::uint32_t* nodes, std::size_t count,
                                      std::uint32_t* children) {
  const Row row = row_of(box);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = std::size_t{nodes[i]} * WideTree::fan;
    unsigned lanes = 0;
    for (std::size_t part = 0; part < WideTree::fan; part += Lanes::width) {
      lanes |= overlaps(row, boxes, first + part) << part;
    }
    found += Lanes::compress(lanes, boxes.ids + first, children + found);
  }
  return found;
}
