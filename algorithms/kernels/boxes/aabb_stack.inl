// The loops of box_list.h. Included by box_list.cpp once for each level of vector instructions,
// inside that level's namespace.

// The first `count` of 16, all where there are more.
inline unsigned first_lanes(std::size_t count) { return count < 16 ? (1u << count) - 1 : 0xffffu; }

TOUCHSTONE_TARGET std::size_t append(const Aabb& bound, const Columns from, IndexRange range,
                                     const Places to, std::size_t end) {
  Row row;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row.min[axis] = Lanes::broadcast(bound.min[axis]);
    row.max[axis] = Lanes::broadcast(bound.max[axis]);
  }
  for (std::size_t j = range.first; j < range.last; j += 16) {
    const unsigned lanes = overlaps16(row, from, j) & first_lanes(range.last - j);
    if (lanes == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      Lanes::compress(lanes, from.min[axis] + j, to.min[axis] + end);
      Lanes::compress(lanes, from.max[axis] + j, to.max[axis] + end);
    }
    end += Lanes::compress(lanes, from.ids + j, to.ids + end);
  }
  return end;
}

TOUCHSTONE_TARGET void pair(const Columns boxes, IndexRange rows, std::size_t end,
                            const Columns list, IndexRange columns, PairBuffer& out) {
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const Row row = load_row(boxes, i);
    const std::uint32_t id = boxes.ids[i];
    for (std::size_t j = columns.first; j < columns.last; j += 16) {
      Lanes::write(overlaps16(row, list, j), id, list.ids + j, out);
    }
    for (std::size_t j = i + 1; j < end; j += 16) {
      const unsigned lanes = overlaps16(row, boxes, j) & first_lanes(end - j);
      Lanes::write(lanes, id, boxes.ids + j, out);
    }
  }
}
