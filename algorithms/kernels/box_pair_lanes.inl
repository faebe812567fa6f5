// The loops of box_pair_lanes.h. Included by box_pair_lanes.cpp once for each level of vector
// instructions, inside that level's namespace.

#include "algorithms/kernels/pair_lanes.inl"

// One pair a lane. Columns of the matrices, offset from a to b, half extents; metres, world axes.
template <class Scalar>
struct BoxColumns {
  Vectors<Scalar> a[3], b[3], offset, half_a, half_b;
};

// A pair seen along the axes of each box: products[i][j] of edge i of a with edge j of b.
template <class Scalar>
struct BoxProducts {
  using Real = typename RealLanes<Scalar>::Real;
  Real products[3][3], offset_a[3], offset_b[3], half_a[3], half_b[3];
  Real size;                    // the sum of the half extents and of the offset's coordinates
  Real face_gaps[6], face_gap;  // along the face normals of a, then of b; the greatest
};

// The pairs from `begin` on, as many as there are lanes; behind the last it is repeated.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void load_boxes(const PairTable<Scalar>& table,
                                                    std::size_t begin, BoxColumns<Scalar>& boxes) {
  using Lanes = RealLanes<Scalar>;
  constexpr std::size_t width = Lanes::width;
  // Quads of the matrices' first eight numbers; the ninth of a beside the offset; half extents,
  // those of b beside the ninth of its matrix.
  alignas(64) Quad<Scalar> quads[7][width];
  Group<Scalar> group;
  start_group<Scalar>(table, begin, group);
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::uint32_t first = group.first[lane], second = group.second[lane];
    const Pose &a = table.pairs.poses[first], &b = table.pairs.poses[second];
    quads[0][lane] = convert<Scalar>(pose_quad(a, 0));
    quads[1][lane] = convert<Scalar>(pose_quad(a, 4));
    quads[2][lane] = convert<Scalar>(pose_quad(b, 0));
    quads[3][lane] = convert<Scalar>(pose_quad(b, 4));
    const Quad<double> end_a = pose_quad(a, 8), end_b = pose_quad(b, 8);
    const Quad<double> between = end_b - end_a;
    quads[4][lane] = convert<Scalar>(__builtin_shufflevector(end_a, between, 0, 5, 6, 7));
    quads[5][lane] = shape_quad<Scalar>(table, first);
    quads[6][lane] = __builtin_shufflevector(shape_quad<Scalar>(table, second),
                                             convert<Scalar>(end_b), 0, 1, 2, 4);
  }
  typename Lanes::Real columns[7][4];
  for (std::size_t k = 0; k < 7; ++k) columns_of<Scalar>(quads[k], columns[k]);
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

// Greatest of the gaps along the edges of either box, as face normals, and what they are made of.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void look_along_faces(const BoxColumns<Scalar>& boxes,
                                                          BoxProducts<Scalar>& seen) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const Real half_a[3] = {boxes.half_a.x, boxes.half_a.y, boxes.half_a.z};
  const Real half_b[3] = {boxes.half_b.x, boxes.half_b.y, boxes.half_b.z};
  for (int k = 0; k < 3; ++k) {
    seen.half_a[k] = half_a[k];
    seen.half_b[k] = half_b[k];
    seen.offset_a[k] = dot<Scalar>(boxes.a[k], boxes.offset);
    seen.offset_b[k] = dot<Scalar>(boxes.b[k], boxes.offset);
  }
  Real* const gaps_b = seen.face_gaps + 3;
  for (int j = 0; j < 3; ++j) gaps_b[j] = Lanes::abs(seen.offset_b[j]) - half_b[j];
  for (int i = 0; i < 3; ++i) {
    seen.face_gaps[i] = Lanes::abs(seen.offset_a[i]) - half_a[i];
    for (int j = 0; j < 3; ++j) {
      seen.products[i][j] = dot<Scalar>(boxes.a[i], boxes.b[j]);
      const Real cosine = Lanes::abs(seen.products[i][j]);
      seen.face_gaps[i] -= half_b[j] * cosine;
      gaps_b[j] -= half_a[i] * cosine;
    }
  }
  seen.face_gap = seen.face_gaps[0];
  for (int k = 1; k < 6; ++k) seen.face_gap = Lanes::max(seen.face_gap, seen.face_gaps[k]);
}

// The greatest gap along the products of two edges, each times the axis' length.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename RealLanes<Scalar>::Real look_along_edges(
    const BoxProducts<Scalar>& seen) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  Real cosines[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) cosines[i][j] = Lanes::abs(seen.products[i][j]);
  }
  Real greatest = Lanes::broadcast(-std::numeric_limits<Scalar>::infinity());
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      // The product of edge i of a with another edge of a is a third one, and so for b.
      const Real between = Lanes::abs(seen.offset_a[i2] * seen.products[i1][j] -
                                      seen.offset_a[i1] * seen.products[i2][j]);
      const Real reach_a = seen.half_a[i1] * cosines[i2][j] + seen.half_a[i2] * cosines[i1][j];
      const Real reach_b = seen.half_b[j1] * cosines[i][j2] + seen.half_b[j2] * cosines[i][j1];
      greatest = Lanes::max(greatest, between - (reach_a + reach_b));
    }
  }
  return greatest;
}

// The axis of edge i of a and j of b, seen along the edges of a, where it has no coordinate i: the
// other two, and the gap along it times its length, which loses nothing where they are almost
// parallel.
template <class Scalar>
struct EdgeAxis {
  typename RealLanes<Scalar>::Real first, second, gap;
};
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE EdgeAxis<Scalar> edge_axis(const BoxProducts<Scalar>& seen,
                                                               int i, int j) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const Real first = -seen.products[i2][j], second = seen.products[i1][j];
  Real gap = Lanes::abs(first * seen.offset_a[i1] + second * seen.offset_a[i2]);
  gap -= seen.half_a[i1] * Lanes::abs(first) + seen.half_a[i2] * Lanes::abs(second);
  for (const int k : {j1, j2}) {
    gap -=
        seen.half_b[k] * Lanes::abs(first * seen.products[i1][k] + second * seen.products[i2][k]);
  }
  return {first, second, gap};
}

// Which lanes overlap by `fine`, and which are apart by it, by that second look at the edges; those
// of which the one or the other is known of the faces.
template <class Scalar>
struct Verdict {
  unsigned apart, overlapping;
};
template <class Scalar>
TOUCHSTONE_TARGET Verdict<Scalar> look_closely(const BoxProducts<Scalar>& seen) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const Real error = GapError<Scalar>::fine * seen.size;
  const Real parallel = Lanes::broadcast(4 * GapError<Scalar>::u);
  unsigned apart = 0, open = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const EdgeAxis<Scalar> axis = edge_axis<Scalar>(seen, i, j);
      const Real length = Lanes::abs(axis.first) + Lanes::abs(axis.second);
      const Real most = error * length;
      // Edges that are parallel up to rounding add no facet that is wide enough to matter.
      const unsigned counts = ~Lanes::bits(Lanes::less(length, parallel));
      apart |= Lanes::bits(Lanes::less(most, axis.gap)) & counts;
      open |= ~Lanes::bits(Lanes::less(axis.gap, -most)) & counts;
    }
  }
  return {apart, ~open & Lanes::bits(Lanes::less(seen.face_gap, -error))};
}

// Lanes that may be answered: sizes that no product takes out of the scalar's range, and matrices
// that are orthonormal. `far`: apart by so much that balls around the boxes are.
struct Usable {
  unsigned far, near;
};
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Usable usable_lanes(const BoxColumns<Scalar>& boxes,
                                                        BoxProducts<Scalar>& seen) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const auto& [a, b, offset, half_a, half_b] = boxes;
  const Real sizes = half_a.x + half_a.y + half_a.z + half_b.x + half_b.y + half_b.z;
  const unsigned sized = sized_lanes<Scalar>(sizes);
  const Real squares_a[3] = {dot<Scalar>(a[0], a[0]), dot<Scalar>(a[1], a[1]),
                             dot<Scalar>(a[2], a[2])};
  const Real squares_b[3] = {dot<Scalar>(b[0], b[0]), dot<Scalar>(b[1], b[1]),
                             dot<Scalar>(b[2], b[2])};
  const Real trace_a = squares_a[0] + squares_a[1] + squares_a[2];
  const Real trace_b = squares_b[0] + squares_b[1] + squares_b[2];
  // The root of the trace bounds what a matrix does to lengths; (x + y)^2 <= 2 x^2 + 2 y^2.
  const Real reach = Scalar(2.01) * (dot<Scalar>(half_a, half_a) * trace_a +
                                     dot<Scalar>(half_b, half_b) * trace_b);
  const unsigned far = sized & Lanes::bits(Lanes::less(reach, dot<Scalar>(offset, offset)));
  if ((~far & ((1u << Lanes::width) - 1)) == 0) return {far, 0};
  const Real one = Lanes::broadcast(1), four = Lanes::broadcast(4);
  Real skew = Lanes::broadcast(0);
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    skew = Lanes::max(skew, Lanes::abs(squares_a[k] - one));
    skew = Lanes::max(skew, Lanes::abs(squares_b[k] - one));
    skew = Lanes::max(skew, Lanes::abs(dot<Scalar>(a[k], a[next])));
    skew = Lanes::max(skew, Lanes::abs(dot<Scalar>(b[k], b[next])));
  }
  // The traces are there for infinities and what is not a number, which a maximum may lose.
  const unsigned orthonormal =
      Lanes::bits(Lanes::less(skew, Lanes::broadcast(greatest_skew<Scalar>))) &
      Lanes::bits(Lanes::less(trace_a, four)) & Lanes::bits(Lanes::less(trace_b, four));
  seen.size = sizes + Lanes::abs(offset.x) + Lanes::abs(offset.y) + Lanes::abs(offset.z);
  return {far, sized & orthonormal & ~far};
}

#include "algorithms/kernels/box_pair_depth.inl"

template <class Scalar>
TOUCHSTONE_TARGET std::size_t solve_boxes(const PairTable<Scalar> table, bool depth) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr std::size_t width = Lanes::width;
  std::size_t left = 0;
  const std::size_t count = table.pairs.first.size();
  for (std::size_t begin = 0; begin < count; begin += width) {
    BoxColumns<Scalar> boxes;
    BoxProducts<Scalar> seen;
    load_boxes<Scalar>(table, begin, boxes);
    const Usable usable = usable_lanes<Scalar>(boxes, seen);
    unsigned apart = usable.far, overlapping = 0;
    if (usable.near != 0) {
      look_along_faces<Scalar>(boxes, seen);
      const Real error = GapError<Scalar>::coarse * seen.size;
      apart |= usable.near & Lanes::bits(Lanes::less(error, seen.face_gap));
      if ((usable.near & ~apart) != 0) {
        const Real edge_gap = look_along_edges<Scalar>(seen);
        apart |= usable.near & Lanes::bits(Lanes::less(error, edge_gap));
        overlapping = usable.near & ~apart &
                      Lanes::bits(Lanes::less(Lanes::max(seen.face_gap, edge_gap), -error));
        const unsigned open = usable.near & ~apart & ~overlapping;
        if (open != 0) {
          const Verdict<Scalar> verdict = look_closely<Scalar>(seen);
          apart |= open & verdict.apart;
          overlapping |= open & ~verdict.apart & verdict.overlapping;
        }
        if (depth && overlapping != 0) {
          overlapping = write_depths<Scalar>(table, begin, boxes, seen, overlapping);
        }
      }
    }
    left = write_answers<Scalar>(table, begin, apart, overlapping, left);
  }
  return left;
}
