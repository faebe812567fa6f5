// The loops of box_scan.h. Included by box_scan.cpp once for each level of vector instructions,
// inside that level's namespace: `Lanes` are its vectors, TOUCHSTONE_TARGET its attribute.

struct Row {
  Lanes::Floats min[3], max[3];
};

TOUCHSTONE_TARGET inline Row load_row(const BoxArrays& boxes, std::size_t row) {
  Row r;
  for (int axis = 0; axis < 3; ++axis) {
    r.min[axis] = Lanes::broadcast(boxes.min(axis)[row]);
    r.max[axis] = Lanes::broadcast(boxes.max(axis)[row]);
  }
  return r;
}

TOUCHSTONE_TARGET inline Lanes::Test overlap_on(Lanes::Test within, const Row& row,
                                                const BoxArrays& boxes, int axis, std::size_t j) {
  within = Lanes::less_equal(within, Lanes::load(boxes.min(axis) + j), row.max[axis]);
  return Lanes::less_equal(within, row.min[axis], Lanes::load(boxes.max(axis) + j));
}

// The lanes from j on whose boxes overlap the row's, as bits; none at or beyond `last`.
TOUCHSTONE_TARGET inline unsigned overlaps(const Row& row, const BoxArrays& boxes, std::size_t j,
                                           std::size_t last) {
  Lanes::Test test = Lanes::less_equal(Lanes::load(boxes.min(0) + j), row.max[0]);
  test = Lanes::less_equal(test, row.min[0], Lanes::load(boxes.max(0) + j));
  test = overlap_on(test, row, boxes, 1, j);
  test = overlap_on(test, row, boxes, 2, j);
  const unsigned lanes = Lanes::bits(test);
  return last - j >= Lanes::width ? lanes : lanes & ((1u << (last - j)) - 1);
}

TOUCHSTONE_TARGET inline std::size_t first_column(std::size_t row, IndexRange columns) {
  return columns.first <= row && row < columns.last ? row + 1 : columns.first;
}

TOUCHSTONE_TARGET void scan(const BoxArrays& boxes, IndexRange rows,
                            std::span<const IndexRange> columns, PairBuffer& out) {
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const Row row = load_row(boxes, i);
    for (const IndexRange range : columns) {
      for (std::size_t j = first_column(i, range); j < range.last; j += Lanes::width) {
        const unsigned lanes = overlaps(row, boxes, j, range.last);
        if (lanes != 0) Lanes::write(lanes, boxes.ids()[i], boxes.ids() + j, out);
      }
    }
  }
}

TOUCHSTONE_TARGET void scan_marked(const BoxArrays& boxes, const std::uint32_t* marks,
                                   const std::uint32_t* wants, IndexRange rows, IndexRange columns,
                                   PairBuffer& out) {
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const Row row = load_row(boxes, i);
    for (std::size_t j = first_column(i, columns); j < columns.last; j += Lanes::width) {
      unsigned lanes = overlaps(row, boxes, j, columns.last);
      if (lanes == 0) continue;
      lanes &= Lanes::holding(marks + j, wants[i]);
      if (lanes != 0) Lanes::write(lanes, boxes.ids()[i], boxes.ids() + j, out);
    }
  }
}

TOUCHSTONE_TARGET void sweep(const BoxArrays& boxes, int axis, IndexRange rows, PairBuffer& out) {
  const int second = (axis + 1) % 3;
  const int third = (axis + 2) % 3;
  constexpr unsigned all = (1u << Lanes::width) - 1;
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const Row row = load_row(boxes, i);
    // The padding starts at infinity, so the sweep ends there at the latest.
    for (std::size_t j = i + 1;; j += Lanes::width) {
      // min[i] <= min[j] <= max[j]: on this axis one comparison decides.
      const Lanes::Test near = Lanes::less_equal(Lanes::load(boxes.min(axis) + j), row.max[axis]);
      const Lanes::Test test =
          overlap_on(overlap_on(near, row, boxes, second, j), row, boxes, third, j);
      const unsigned lanes = Lanes::bits(test);
      if (lanes != 0) Lanes::write(lanes, boxes.ids()[i], boxes.ids() + j, out);
      if (Lanes::bits(near) != all) break;
    }
  }
}
