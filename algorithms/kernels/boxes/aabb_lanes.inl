// What every loop over box_lanes.h begins with. Included by it once for each level of vector
// instructions.

struct Row {
  Lanes::Floats min[3], max[3];
};

TOUCHSTONE_TARGET inline Row load_row(const Columns& boxes, std::size_t row) {
  Row r;
  for (int axis = 0; axis < 3; ++axis) {
    r.min[axis] = Lanes::broadcast(boxes.min[axis][row]);
    r.max[axis] = Lanes::broadcast(boxes.max[axis][row]);
  }
  return r;
}

TOUCHSTONE_TARGET inline Lanes::Test overlap_on(Lanes::Test within, const Row& row,
                                                const Columns& boxes, int axis, std::size_t j) {
  within = Lanes::less_equal(within, Lanes::load(boxes.min[axis] + j), row.max[axis]);
  return Lanes::less_equal(within, row.min[axis], Lanes::load(boxes.max[axis] + j));
}

// Which of the boxes from j on, a vector of them, overlap the row's.
TOUCHSTONE_TARGET inline unsigned overlaps(const Row& row, const Columns& boxes, std::size_t j) {
  Lanes::Test test = Lanes::less_equal(Lanes::load(boxes.min[0] + j), row.max[0]);
  test = Lanes::less_equal(test, row.min[0], Lanes::load(boxes.max[0] + j));
  test = overlap_on(test, row, boxes, 1, j);
  return Lanes::bits(overlap_on(test, row, boxes, 2, j));
}

// The same of 16 boxes.
TOUCHSTONE_TARGET inline unsigned overlaps16(const Row& row, const Columns& boxes, std::size_t j) {
  unsigned lanes = 0;
  for (std::size_t part = 0; part < 16; part += Lanes::width) {
    lanes |= overlaps(row, boxes, j + part) << part;
  }
  return lanes;
}

// Sixteen boxes from j on, kept in registers where there are enough.
struct Sixteen {
  static constexpr std::size_t parts = 16 / Lanes::width;
  Lanes::Floats min[3][parts], max[3][parts];
};

TOUCHSTONE_TARGET inline Sixteen load_sixteen(const Columns& boxes, std::size_t j) {
  Sixteen s;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t part = 0; part < Sixteen::parts; ++part) {
      s.min[axis][part] = Lanes::load(boxes.min[axis] + j + part * Lanes::width);
      s.max[axis][part] = Lanes::load(boxes.max[axis] + j + part * Lanes::width);
    }
  }
  return s;
}

// Which of them overlap a box.
TOUCHSTONE_TARGET inline unsigned overlaps(const Columns& boxes, std::size_t row,
                                           const Sixteen& s) {
  const Row r = load_row(boxes, row);
  unsigned lanes = 0;
  for (std::size_t part = 0; part < Sixteen::parts; ++part) {
    Lanes::Test test = Lanes::less_equal(s.min[0][part], r.max[0]);
    test = Lanes::less_equal(test, r.min[0], s.max[0][part]);
    for (int axis = 1; axis < 3; ++axis) {
      test = Lanes::less_equal(test, s.min[axis][part], r.max[axis]);
      test = Lanes::less_equal(test, r.min[axis], s.max[axis][part]);
    }
    lanes |= Lanes::bits(test) << (part * Lanes::width);
  }
  return lanes;
}
