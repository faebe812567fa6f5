// The tests of aabb_simd.h, which includes this file once for each level of vector instructions.

using Lanes = Simd<float>;

// One box, copied to every lane.
struct Row {
  Lanes::Vector min[3], max[3];
};

TOUCHSTONE_TARGET inline Row load_row(const Columns& boxes, std::size_t row) {
  Row r;
  for (int axis = 0; axis < 3; ++axis) {
    r.min[axis] = Lanes::broadcast(boxes.min[axis][row]);
    r.max[axis] = Lanes::broadcast(boxes.max[axis][row]);
  }
  return r;
}
TOUCHSTONE_TARGET inline Row row_of(const Aabb& box) {
  Row r;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    r.min[axis] = Lanes::broadcast(box.min[axis]);
    r.max[axis] = Lanes::broadcast(box.max[axis]);
  }
  return r;
}

TOUCHSTONE_TARGET inline Lanes::Mask overlap_on(Lanes::Mask within, const Row& row,
                                                const Columns& boxes, int axis, std::size_t j) {
  within = Lanes::less_equal(within, Lanes::load(boxes.min[axis] + j), row.max[axis]);
  return Lanes::less_equal(within, row.min[axis], Lanes::load(boxes.max[axis] + j));
}

// Returns the bits of the boxes that overlap the row's, among a vector of them from j on.
TOUCHSTONE_TARGET inline unsigned overlaps(const Row& row, const Columns& boxes, std::size_t j) {
  Lanes::Mask test = Lanes::less_equal(Lanes::load(boxes.min[0] + j), row.max[0]);
  test = Lanes::less_equal(test, row.min[0], Lanes::load(boxes.max[0] + j));
  test = overlap_on(test, row, boxes, 1, j);
  return Lanes::to_bits(overlap_on(test, row, boxes, 2, j));
}

// Returns the bits of the boxes that overlap the row's, among 16 from j on.
TOUCHSTONE_TARGET inline unsigned overlaps16(const Row& row, const Columns& boxes, std::size_t j) {
  unsigned bits = 0;
  for (std::size_t part = 0; part < 16; part += Lanes::width) {
    bits |= overlaps(row, boxes, j + part) << part;
  }
  return bits;
}

// Sixteen boxes, in registers if there are enough.
struct Block16 {
  static constexpr std::size_t parts = 16 / Lanes::width;
  Lanes::Vector min[3][parts], max[3][parts];
};

TOUCHSTONE_TARGET inline Block16 load_block16(const Columns& boxes, std::size_t j) {
  Block16 block;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t part = 0; part < Block16::parts; ++part) {
      block.min[axis][part] = Lanes::load(boxes.min[axis] + j + part * Lanes::width);
      block.max[axis][part] = Lanes::load(boxes.max[axis] + j + part * Lanes::width);
    }
  }
  return block;
}

// Returns the bits of the block's boxes that overlap the row's.
TOUCHSTONE_TARGET inline unsigned overlaps16(const Row& row, const Block16& block) {
  unsigned bits = 0;
  for (std::size_t part = 0; part < Block16::parts; ++part) {
    Lanes::Mask test = Lanes::less_equal(block.min[0][part], row.max[0]);
    test = Lanes::less_equal(test, row.min[0], block.max[0][part]);
    for (int axis = 1; axis < 3; ++axis) {
      test = Lanes::less_equal(test, block.min[axis][part], row.max[axis]);
      test = Lanes::less_equal(test, row.min[axis], block.max[axis][part]);
    }
    bits |= Lanes::to_bits(test) << (part * Lanes::width);
  }
  return bits;
}

// Copies the boxes from[j .. j + 15] whose bits are set to to[end..], which has room for 16, and
// returns their number.
TOUCHSTONE_TARGET inline std::size_t compress_boxes(unsigned bits, const Columns& from,
                                                    std::size_t j, const MutableColumns& to,
                                                    std::size_t end) {
  for (int axis = 0; axis < 3; ++axis) {
    Lanes::compress(bits, from.min[axis] + j, to.min[axis] + end);
    Lanes::compress(bits, from.max[axis] + j, to.max[axis] + end);
  }
  return Lanes::compress(bits, from.ids + j, to.ids + end);
}
