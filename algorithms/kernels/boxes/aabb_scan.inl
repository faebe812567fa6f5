// The loops of aabb_scan.h. aabb_scan.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.

TOUCHSTONE_TARGET inline std::size_t first_column(std::size_t row, IndexRange columns) {
  return columns.first <= row && row < columns.last ? row + 1 : columns.first;
}

template <bool marked>
TOUCHSTONE_TARGET inline void write(unsigned lanes, std::size_t i, std::size_t j,
                                    const Columns& boxes, const Marks& marks, PairBuffer& out) {
  if (lanes == 0) return;
  if constexpr (marked) {
    lanes &= Lanes::test(marks.marks + j, marks.wants[i]);
    if (lanes == 0) return;
  }
  PairWriter::write(lanes, boxes.ids[i], boxes.ids + j, out);
}

template <bool marked>
TOUCHSTONE_TARGET inline void scan_range(std::size_t i, const Row& row, const Columns& boxes,
                                         const Marks& marks, IndexRange range, PairBuffer& out) {
  constexpr std::size_t width = Lanes::width;
  std::size_t j = first_column(i, range);
  // A shorter first vector aligns the others; it is left out if it is the only one.
  if (j % width != 0 && range.last > j + width) {
    const std::size_t end = j / width * width + width;
    write<marked>(overlaps(row, boxes, j) & ((1u << (end - j)) - 1), i, j, boxes, marks, out);
    j = end;
  }
  for (; j + width <= range.last; j += width) {
    write<marked>(overlaps(row, boxes, j), i, j, boxes, marks, out);
  }
  if (j < range.last) {
    write<marked>(overlaps(row, boxes, j) & ((1u << (range.last - j)) - 1), i, j, boxes, marks,
                  out);
  }
}

TOUCHSTONE_TARGET void scan(const Columns boxes, IndexRange rows,
                            std::span<const IndexRange> columns, PairBuffer& out) {
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const Row row = load_row(boxes, i);
    for (const IndexRange range : columns) scan_range<false>(i, row, boxes, {}, range, out);
  }
}

TOUCHSTONE_TARGET void scan_marked(const Columns boxes, const Marks marks, IndexRange rows,
                                   IndexRange columns, PairBuffer& out) {
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    scan_range<true>(i, load_row(boxes, i), boxes, marks, columns, out);
  }
}

template <bool marked>
TOUCHSTONE_TARGET inline void sweep_rows(const Columns& boxes, int axis, const Marks& marks,
                                         IndexRange rows, std::size_t end, PairBuffer& out) {
  const int second = (axis + 1) % 3;
  const int third = (axis + 2) % 3;
  const Columns turned{{boxes.min[axis], boxes.min[second], boxes.min[third]},
                       {boxes.max[axis], boxes.max[second], boxes.max[third]},
                       boxes.ids};
  constexpr std::size_t width = Lanes::width;
  constexpr unsigned all = (1u << width) - 1;
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const Row row = load_row(turned, i);
    for (std::size_t j = i + 1;; j += width) {
      if constexpr (marked) {
        if (j >= end) break;
      }
      // Since min[i] <= min[j] <= max[j], one comparison decides on this axis.
      const Lanes::Mask near = Lanes::less_equal(Lanes::load(turned.min[0] + j), row.max[0]);
      const Lanes::Mask test = overlap_on(overlap_on(near, row, turned, 1, j), row, turned, 2, j);
      unsigned lanes = Lanes::to_bits(test);
      if constexpr (marked) {
        if (end - j < width) lanes &= (1u << (end - j)) - 1;
      }
      write<marked>(lanes, i, j, turned, marks, out);
      if (Lanes::to_bits(near) != all) break;
    }
  }
}

// The padding starts at infinity, so the sweep ends there at the latest.
TOUCHSTONE_TARGET void sweep(const Columns boxes, int axis, IndexRange rows, PairBuffer& out) {
  sweep_rows<false>(boxes, axis, {}, rows, 0, out);
}

TOUCHSTONE_TARGET void sweep_marked(const Columns boxes, const Marks marks, int axis,
                                    IndexRange rows, std::size_t end, PairBuffer& out) {
  sweep_rows<true>(boxes, axis, marks, rows, end, out);
}
