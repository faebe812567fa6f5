// Loads pairs of boxes into lanes. box_pair_lanes.inl includes this file.

#include "algorithms/kernels/batch/pair_lanes.inl"

// One pair in each lane: columns of the matrices, offset from a to b, half extents; metres, world
// axes.
template <class Scalar>
struct BoxColumns {
  Vector3<Scalar> a[3], b[3], offset, half_a, half_b;
};

// The general loader: doubles are transposed from rows to columns as they are loaded.
template <class Scalar>
class BoxLoader {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;

 public:
  // The first group is that from `begin` on.
  TOUCHSTONE_TARGET BoxLoader(const PairTable<Scalar>& table, std::size_t /*begin*/)
      : table_(table) {}

  // Loads one pair a lane from `begin` on; the last pair fills up the lanes.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load(std::size_t begin, BoxColumns<Scalar>& boxes) {
    Group<Scalar> group;
    start_group<Scalar>(table_, begin, group);
    Vector3<Scalar> centre_a, centre_b;
    load_side(group.first, boxes.a, centre_a, boxes.half_a);
    load_side(group.second, boxes.b, centre_b, boxes.half_b);
    boxes.offset = {centre_b.x - centre_a.x, centre_b.y - centre_a.y, centre_b.z - centre_a.z};
  }

 private:
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load_side(const std::uint32_t* bodies,
                                                     Vector3<Scalar> matrix[3],
                                                     Vector3<Scalar>& centre,
                                                     Vector3<Scalar>& half) const {
    const Scalar *poses[Lanes::width], *shapes[Lanes::width];
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
      poses[lane] = reinterpret_cast<const Scalar*>(&table_.pairs.poses[bodies[lane]]);
      shapes[lane] = table_.shapes + std::size_t{4} * table_.pairs.shape_of[bodies[lane]];
    }
    Vector columns[4][4];
    for (std::size_t quad = 0; quad < 3; ++quad) {
      columns_at(poses, columns[quad]);
      for (const Scalar*& pose : poses) pose += 4;
    }
    columns_at(shapes, columns[3]);
    matrix[0] = {columns[0][0], columns[0][1], columns[0][2]};
    matrix[1] = {columns[0][3], columns[1][0], columns[1][1]};
    matrix[2] = {columns[1][2], columns[1][3], columns[2][0]};
    centre = {columns[2][1], columns[2][2], columns[2][3]};
    half = {columns[3][0], columns[3][1], columns[3][2]};
  }

  TOUCHSTONE_TARGET static TOUCHSTONE_INLINE void columns_at(const Scalar* const* quads,
                                                             Vector columns[4]) {
    for (std::size_t k = 0; k < 4; ++k) columns[k] = Lanes::concat_at(quads + k);
    Lanes::transpose(columns);
  }

  const PairTable<Scalar>& table_;
};

// The loader for float narrows quads after the offset is computed, and stores them. If four quads
// make a vector they are stored next to each other, each at its place. A processor that reads such
// a vector waits until all four are written, so each group is gathered while the one before it is
// processed.
template <>
class BoxLoader<float> {
  using Lanes = Simd<float>;

 public:
  TOUCHSTONE_TARGET BoxLoader(const PairTable<float>& table, std::size_t begin) : table_(table) {
    if (side_by_side) gather(begin);
  }

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load(std::size_t begin, BoxColumns<float>& boxes) {
    gather(side_by_side ? begin + Lanes::width : begin);
    const Rows& rows = rows_of(begin);
    Lanes::Vector columns[7][4];
    for (std::size_t k = 0; k < 7; ++k) {
      if constexpr (side_by_side) {
        placed_columns<float>(rows[k], columns[k]);
      } else {
        columns_of<float>(rows[k], columns[k]);
      }
    }
    boxes.a[0] = {columns[0][0], columns[0][1], columns[0][2]};
    boxes.a[1] = {columns[0][3], columns[1][0], columns[1][1]};
    boxes.a[2] = {columns[1][2], columns[1][3], columns[4][0]};
    boxes.b[0] = {columns[2][0], columns[2][1], columns[2][2]};
    boxes.b[1] = {columns[2][3], columns[3][0], columns[3][1]};
    boxes.b[2] = {columns[3][2], columns[3][3], columns[6][3]};
    boxes.offset = {columns[4][1], columns[4][2], columns[4][3]};
    boxes.half_a = {columns[5][0], columns[5][1], columns[5][2]};
    boxes.half_b = {columns[6][0], columns[6][1], columns[6][2]};
  }

 private:
  static constexpr bool side_by_side = Lanes::width == 16;

  // Quads of the matrices' first eight numbers; the ninth of a next to the offset; half extents,
  // those of b next to the ninth number of its matrix.
  using Rows = Quad<float>[7][Lanes::width];

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Rows& rows_of(std::size_t begin) {
    return rows_[begin / Lanes::width % 2];
  }

  // Gathers the pairs from `begin` on, if there are any.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void gather(std::size_t begin) {
    if (begin >= table_.pairs.first.size()) return;
    Group<float> group;
    start_group<float>(table_, begin, group);
    Rows& rows = rows_of(begin);
#pragma GCC unroll 16
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
      const std::size_t at = side_by_side ? place<Lanes>(lane) : lane;
      const std::uint32_t first = group.first[lane], second = group.second[lane];
      const Pose &a = table_.pairs.poses[first], &b = table_.pairs.poses[second];
      rows[0][at] = convert<float>(pose_quad(a, 0));
      rows[1][at] = convert<float>(pose_quad(a, 4));
      rows[2][at] = convert<float>(pose_quad(b, 0));
      rows[3][at] = convert<float>(pose_quad(b, 4));
      const Quad<double> end_a = pose_quad(a, 8), end_b = pose_quad(b, 8);
      const Quad<double> between = end_b - end_a;
      rows[4][at] = convert<float>(__builtin_shufflevector(end_a, between, 0, 5, 6, 7));
      rows[5][at] = shape_quad<float>(table_, first);
      rows[6][at] = __builtin_shufflevector(shape_quad<float>(table_, second),
                                            convert<float>(end_b), 0, 1, 2, 4);
    }
  }

  const PairTable<float>& table_;
  alignas(64) Rows rows_[2];
};
