// The tests of aabb_simd.h, which includes this file once for each level of vector instructions.

using Lanes = Simd<float>;

// One box, copied to every lane.
struct Row {
  Lanes::Vector min[3], max[3];
};

// A vector of boxes.
struct BoxLanes {
  Lanes::Vector min[3], max[3];
};

// Loads the boxes at the addresses box_at(lane).
template <class BoxAt>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load_boxes(const BoxAt& box_at, BoxLanes& boxes) {
  static_assert(sizeof(Aabb) == 6 * sizeof(float));
  simd::Quad<float> front[Lanes::width], back[Lanes::width];  // min x y z, max x; min z, max x y z
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
    const Aabb* const box = box_at(lane);
    std::memcpy(&front[lane], &box->min[0], sizeof front[lane]);
    std::memcpy(&back[lane], &box->min[2], sizeof back[lane]);
  }
  Lanes::Vector r[4], s[4];
  for (int k = 0; k < 4; ++k) {
    r[k] = Lanes::concat(front + k);
    s[k] = Lanes::concat(back + k);
  }
  Lanes::transpose(r);
  Lanes::transpose(s);
  for (int k = 0; k < 3; ++k) {
    boxes.min[k] = r[k];
    boxes.max[k] = s[k + 1];
  }
}

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

// Returns the boxes, of those `within` a vector of them from j on, that overlap the row's on an axis.
TOUCHSTONE_TARGET inline Lanes::Mask overlap_on(Lanes::Mask within, const Row& row,
                                                const Columns& boxes, int axis, std::size_t j) {
  return Lanes::meet(within, row.min[axis], row.max[axis], Lanes::load(boxes.min[axis] + j),
                     Lanes::load(boxes.max[axis] + j));
}

// Returns the bits of the boxes that overlap the row's, among a vector of them.
TOUCHSTONE_TARGET inline unsigned overlaps(const Row& row, const Lanes::Vector (&min)[3],
                                           const Lanes::Vector (&max)[3]) {
  Lanes::Mask test = Lanes::meet(row.min[0], row.max[0], min[0], max[0]);
  for (int axis = 1; axis < 3; ++axis) {
    test = Lanes::meet(test, row.min[axis], row.max[axis], min[axis], max[axis]);
  }
  return Lanes::to_bits(test);
}
TOUCHSTONE_TARGET inline unsigned overlaps(const Row& row, const Columns& boxes, std::size_t j) {
  Lanes::Vector min[3], max[3];
  for (int axis = 0; axis < 3; ++axis) {
    min[axis] = Lanes::load(boxes.min[axis] + j);
    max[axis] = Lanes::load(boxes.max[axis] + j);
  }
  return overlaps(row, min, max);
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
  Lanes::Vector min[parts][3], max[parts][3];
};

TOUCHSTONE_TARGET inline Block16 load_block16(const Columns& boxes, std::size_t j) {
  Block16 block;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t part = 0; part < Block16::parts; ++part) {
      block.min[part][axis] = Lanes::load(boxes.min[axis] + j + part * Lanes::width);
      block.max[part][axis] = Lanes::load(boxes.max[axis] + j + part * Lanes::width);
    }
  }
  return block;
}

// Returns the bits of the block's boxes that overlap the row's.
TOUCHSTONE_TARGET inline unsigned overlaps16(const Row& row, const Block16& block) {
  unsigned bits = 0;
  for (std::size_t part = 0; part < Block16::parts; ++part) {
    bits |= overlaps(row, block.min[part], block.max[part]) << (part * Lanes::width);
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
