// The loops of aabb_stack.h. aabb_stack.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.

TOUCHSTONE_TARGET std::size_t append(const Aabb& bound, const Columns from, IndexRange range,
                                     const MutableColumns to, std::size_t end) {
  const Row row = row_of(bound);
  for (std::size_t j = range.first; j < range.last; j += 16) {
    const unsigned bits = overlaps16(row, from, j) & first_lanes(range.last - j);
    if (bits == 0) continue;
    end += compress_boxes(bits, from, j, to, end);
  }
  return end;
}

TOUCHSTONE_TARGET void pair(const Columns boxes, IndexRange rows, std::size_t end,
                            const Columns list, IndexRange columns, PairBuffer& out) {
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const Row row = load_row(boxes, i);
    const std::uint32_t id = boxes.ids[i];
    for (std::size_t j = columns.first; j < columns.last; j += 16) {
      PairWriter::write(overlaps16(row, list, j), id, list.ids + j, out);
    }
    for (std::size_t j = i + 1; j < end; j += 16) {
      const unsigned bits = overlaps16(row, boxes, j) & first_lanes(end - j);
      PairWriter::write(bits, id, boxes.ids + j, out);
    }
  }
}
