// The loops of box_pair_lanes.h. box_pair_lanes.cpp includes them once for each level of vector
// instructions, inside that level's namespace.

#include "algorithms/kernels/batch/box_pair_load.inl"
#include "algorithms/kernels/simd/vector3.inl"

// A pair in the axes of each box; products[i][j] is the product of edge i of a and edge j of b.
template <class Scalar>
struct BoxProducts {
  using Vector = typename Simd<Scalar>::Vector;
  Vector products[3][3], offset_a[3], offset_b[3], half_a[3], half_b[3];
  Vector size;                    // sum of the half extents and of the offset's coordinates
  Vector face_gaps[6], face_gap;  // along the face normals of a, then of b; and the greatest
};

// Computes the gaps along the edges of either box, as face normals, and the products for them.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void look_along_faces(const BoxColumns<Scalar>& boxes,
                                                          BoxProducts<Scalar>& seen) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector half_a[3] = {boxes.half_a.x, boxes.half_a.y, boxes.half_a.z};
  const Vector half_b[3] = {boxes.half_b.x, boxes.half_b.y, boxes.half_b.z};
  for (int k = 0; k < 3; ++k) {
    seen.half_a[k] = half_a[k];
    seen.half_b[k] = half_b[k];
    seen.offset_a[k] = dot<Scalar>(boxes.a[k], boxes.offset);
    seen.offset_b[k] = dot<Scalar>(boxes.b[k], boxes.offset);
  }
  Vector* const gaps_b = seen.face_gaps + 3;
  for (int j = 0; j < 3; ++j) gaps_b[j] = Lanes::abs(seen.offset_b[j]) - half_b[j];
  for (int i = 0; i < 3; ++i) {
    seen.face_gaps[i] = Lanes::abs(seen.offset_a[i]) - half_a[i];
    for (int j = 0; j < 3; ++j) {
      seen.products[i][j] = dot<Scalar>(boxes.a[i], boxes.b[j]);
      const Vector cosine = Lanes::abs(seen.products[i][j]);
      seen.face_gaps[i] -= half_b[j] * cosine;
      gaps_b[j] -= half_a[i] * cosine;
    }
  }
  seen.face_gap = seen.face_gaps[0];
  for (int k = 1; k < 6; ++k) seen.face_gap = Lanes::max(seen.face_gap, seen.face_gaps[k]);
}

// Returns the greatest gap along the products of two edges, each times the axis' length.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<Scalar>::Vector look_along_edges(
    const BoxProducts<Scalar>& seen) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  Vector cosines[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) cosines[i][j] = Lanes::abs(seen.products[i][j]);
  }
  Vector greatest = Lanes::broadcast(-std::numeric_limits<Scalar>::infinity());
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      // The product of two edges of a box is its third.
      const Vector between = Lanes::abs(seen.offset_a[i2] * seen.products[i1][j] -
                                        seen.offset_a[i1] * seen.products[i2][j]);
      const Vector reach_a = seen.half_a[i1] * cosines[i2][j] + seen.half_a[i2] * cosines[i1][j];
      const Vector reach_b = seen.half_b[j1] * cosines[i][j2] + seen.half_b[j2] * cosines[i][j1];
      greatest = Lanes::max(greatest, between - (reach_a + reach_b));
    }
  }
  return greatest;
}

// An axis perpendicular to two edges, in coordinates along the edges of a. The coordinate along its
// own edge is zero; `first` and `second` are the other two. `gap` is the gap times the axis'
// length, and is accurate even if the edges are almost parallel.
template <class Scalar>
struct EdgeAxis {
  typename Simd<Scalar>::Vector first, second, gap;
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<Scalar>::Vector square_length(
    const EdgeAxis<Scalar>& axis) {
  return axis.first * axis.first + axis.second * axis.second;
}

// Computes the axes of edge i of a with each edge of b.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void edge_axes(const BoxProducts<Scalar>& seen, int i,
                                                   EdgeAxis<Scalar> axes[3]) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
  const auto &first = seen.products[i1], &second = seen.products[i2];
  // The extent of edge j1 along the axis of edge j2, which is that of j2 along the axis of j1.
  Vector along[3];
  for (int j = 0; j < 3; ++j) {
    const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    along[j] = Lanes::abs(first[j1] * second[j2] - second[j1] * first[j2]);
  }
  for (int j = 0; j < 3; ++j) {
    const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    Vector gap = Lanes::abs(first[j] * seen.offset_a[i2] - second[j] * seen.offset_a[i1]);
    gap -= seen.half_a[i1] * Lanes::abs(second[j]) + seen.half_a[i2] * Lanes::abs(first[j]);
    gap -= seen.half_b[j1] * along[j2] + seen.half_b[j2] * along[j1];
    axes[j] = {-second[j], first[j], gap};
  }
}

// The state of the lanes: those that may be decided and are not far apart, and of these the ones
// that are separated and the ones that overlap.
struct Signs {
  unsigned near, apart, overlapping;
  unsigned open() const { return near & ~apart & ~overlapping; }
};

// Decides lanes by all axes, to `coarse`.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void judge_by_edges(const BoxProducts<Scalar>& seen,
                                                        Signs& signs) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector error = GapError<Scalar>::coarse * seen.size;
  const Vector gap = look_along_edges<Scalar>(seen);
  signs.apart |= signs.open() & Lanes::to_bits(Lanes::less(error, gap));
  signs.overlapping |=
      signs.open() & Lanes::to_bits(Lanes::less(Lanes::max(seen.face_gap, gap), -error));
}

// Decides lanes by all axes, and the lanes that stay open by another test of the edges, to `fine`.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void judge(const BoxProducts<Scalar>& seen, Signs& signs) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  if (signs.open() == 0) return;
  judge_by_edges<Scalar>(seen, signs);
  if (signs.open() == 0) return;
  const Vector error = GapError<Scalar>::fine * seen.size;
  const Vector parallel = Lanes::broadcast(GapError<Scalar>::parallel);
  unsigned apart = 0, open = 0;
  for (int i = 0; i < 3; ++i) {
    EdgeAxis<Scalar> axes[3];
    edge_axes<Scalar>(seen, i, axes);
    for (const EdgeAxis<Scalar>& axis : axes) {
      // This is at least the axis' length.
      const Vector length = Lanes::abs(axis.first) + Lanes::abs(axis.second);
      const Vector most = error * length;
      const unsigned counts = ~Lanes::to_bits(Lanes::less(square_length<Scalar>(axis), parallel));
      apart |= Lanes::to_bits(Lanes::less(most, axis.gap)) & counts;
      open |= ~Lanes::to_bits(Lanes::less(axis.gap, -most)) & counts;
    }
  }
  signs.apart |= signs.open() & apart;
  signs.overlapping |= signs.open() & ~open & Lanes::to_bits(Lanes::less(seen.face_gap, -error));
}

// Does the same, and is not inlined: the loops of distance and depth, where it is a small part of the
// work, share one copy.
template <class Scalar>
[[gnu::noinline]] TOUCHSTONE_TARGET void judge_apart(const BoxProducts<Scalar>& seen,
                                                     Signs& signs) {
  judge<Scalar>(seen, signs);
}

// The lanes that may be decided: their sizes keep products within the scalar's range, and their
// matrices are orthonormal. In `far` lanes even balls around the boxes are disjoint.
struct Usable {
  unsigned far, near;
};
template <class Scalar, bool far_too>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Usable usable_lanes(const BoxColumns<Scalar>& boxes,
                                                        BoxProducts<Scalar>& seen) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const auto& [a, b, offset, half_a, half_b] = boxes;
  const Vector size_a = half_a.x + half_a.y + half_a.z, size_b = half_b.x + half_b.y + half_b.z;
  const Vector sizes = size_a + size_b;
  seen.size = sizes + Lanes::abs(offset.x) + Lanes::abs(offset.y) + Lanes::abs(offset.z);
  const unsigned sized = sized_lanes<Scalar>(sizes);
  const Vector squares_a[3] = {dot<Scalar>(a[0], a[0]), dot<Scalar>(a[1], a[1]),
                               dot<Scalar>(a[2], a[2])};
  const Vector squares_b[3] = {dot<Scalar>(b[0], b[0]), dot<Scalar>(b[1], b[1]),
                               dot<Scalar>(b[2], b[2])};
  const Vector trace_a = squares_a[0] + squares_a[1] + squares_a[2];
  const Vector trace_b = squares_b[0] + squares_b[1] + squares_b[2];
  // The root of the trace bounds the factor by which a matrix stretches lengths, and the sum of the
  // half extents bounds their diagonal; (x + y)^2 <= 2 x^2 + 2 y^2.
  const Vector reach = Scalar(2.01) * (size_a * size_a * trace_a + size_b * size_b * trace_b);
  // The squares of far shorter columns underflow and give no bound.
  const Vector shortest = Lanes::broadcast(Scalar(1e-12));
  const unsigned far =
      far_too ? 0
              : sized & Lanes::to_bits(Lanes::less(shortest, Lanes::min(trace_a, trace_b))) &
                    Lanes::to_bits(Lanes::less(reach, dot<Scalar>(offset, offset)));
  if ((~far & ((1u << Lanes::width) - 1)) == 0) return {far, 0};
  const Vector one = Lanes::broadcast(1);
  Vector skew_a = Lanes::broadcast(0), skew_b = skew_a;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    skew_a = Lanes::max_abs(skew_a, squares_a[k] - one);
    skew_b = Lanes::max_abs(skew_b, squares_b[k] - one);
    skew_a = Lanes::max_abs(skew_a, dot<Scalar>(a[k], a[next]));
    skew_b = Lanes::max_abs(skew_b, dot<Scalar>(b[k], b[next]));
  }
  const Vector skew = Lanes::max(skew_a, skew_b);
  // The traces detect infinities and NaN, which a maximum may lose.
  const unsigned orthonormal =
      Lanes::to_bits(Lanes::less(skew, Lanes::broadcast(greatest_skew<Scalar>))) &
      Lanes::to_bits(Lanes::less(trace_a + trace_b, Lanes::broadcast(8)));
  const unsigned reached = far_too ? sized_lanes<Scalar>(seen.size) : ~far;
  return {far, sized & orthonormal & reached};
}

#include "algorithms/kernels/batch/box_pair_depth.inl"
#include "algorithms/kernels/batch/box_pair_distance.inl"
#include "algorithms/kernels/batch/box_pair_rest.inl"

// The lanes whose faces leave open on which side of contact they are.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned resting_lanes(const BoxProducts<Scalar>& seen) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector error = GapError<Scalar>::coarse * seen.size;
  return ~Lanes::to_bits(Lanes::less(error, Lanes::abs(seen.face_gap)));
}

// Settles the lanes that rest, and writes their numbers. The touching ones are in `near`.
template <class Scalar, Task task>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Signs settle_resting(const PairTable<Scalar>& table,
                                                         std::size_t begin,
                                                         const BoxColumns<Scalar>& boxes,
                                                         const BoxProducts<Scalar>& seen,
                                                         unsigned resting) {
  const FaceMeeting<Scalar> found = meet_at_face<Scalar>(boxes, seen, resting);
  if constexpr (task == Task::intersect) {
    if (found.touching != 0) write_bounds<Scalar>(table, begin, found.touching, found.numbers);
    return {found.touching, found.apart, found.overlapping};
  } else {
    constexpr bool distance = task == Task::distance;
    const unsigned asked = distance ? found.apart : found.overlapping;
    write_numbers<Scalar>(table, begin, found.measured & (found.touching | asked), found.numbers);
    return {found.touching, distance ? found.apart & found.measured : found.apart,
            found.overlapping};
  }
}

// Solves groups of pairs from `begin` on: until some of a group rest, which is left for the other
// loop, or with `resting` while some of them do. Each loop keeps in registers what it needs.
// Returns where it ended.
template <class Scalar, Task task, bool resting>
TOUCHSTONE_TARGET std::size_t solve_groups(const PairTable<Scalar> table, std::size_t begin,
                                           std::size_t& left) {
  using Lanes = Simd<Scalar>;
  constexpr bool depth = task == Task::penetration, distance = task == Task::distance;
  const std::size_t count = table.pairs.first.size();
  BoxLoader<Scalar> loader(table, begin);
  for (; begin < count; begin += Lanes::width) {
    BoxColumns<Scalar> boxes;
    BoxProducts<Scalar> seen;
    loader.load(begin, boxes);
    const Usable usable = usable_lanes<Scalar, distance>(boxes, seen);
    Signs signs{usable.near, 0, 0}, settled{0, 0, 0};
    bool rests = false;
    if (signs.near != 0) {
      look_along_faces<Scalar>(boxes, seen);
      signs.apart = signs.near & Lanes::to_bits(Lanes::less(GapError<Scalar>::coarse * seen.size,
                                                            seen.face_gap));
      if (signs.open() != 0) {
        const unsigned lanes = signs.open() & resting_lanes<Scalar>(seen);
        rests = lanes != 0;
        if constexpr (resting) {
          if (rests) settled = settle_resting<Scalar, task>(table, begin, boxes, seen, lanes);
          signs.near &= ~(settled.near | settled.apart | settled.overlapping);
        } else {
          if (rests) return begin;
        }
      }
      // Boxes that no face separates are likely to overlap, and the least depth proves that too.
      // The order of the proofs does not change the answer.
      const bool depth_first = depth && signs.apart == 0 && (!resting || signs.near != 0);
      if constexpr (task == Task::intersect) {
        judge<Scalar>(seen, signs);
      } else if (!depth_first) {
        judge_apart<Scalar>(seen, signs);
      }
      LeastAxis<Scalar> least{};
      if constexpr (depth) {
        if (depth_first || signs.overlapping != 0) least = least_axis<Scalar>(seen, signs);
      }
      if (depth_first) judge_apart<Scalar>(seen, signs);
      if (depth && signs.overlapping != 0) {
        signs.overlapping =
            write_depths<Scalar>(table, begin, boxes, seen, least, signs.overlapping);
      }
      if (distance && signs.apart != 0) {
        signs.apart = write_distances<Scalar>(table, begin, boxes, seen, signs.apart);
      }
    }
    left = write_answers<Scalar>(table, begin, usable.far | signs.apart | settled.apart,
                                 signs.overlapping | settled.overlapping | settled.near, left);
    if constexpr (resting) {
      if (settled.near != 0) write_touching<Scalar>(table, begin, settled.near);
      if (!rests) return begin + Lanes::width;
    }
  }
  return begin;
}

template <class Scalar, Task task>
TOUCHSTONE_TARGET std::size_t solve_task(const PairTable<Scalar>& table) {
  std::size_t left = 0, begin = 0;
  while (begin < table.pairs.first.size()) {
    begin = solve_groups<Scalar, task, false>(table, begin, left);
    begin = solve_groups<Scalar, task, true>(table, begin, left);
  }
  return left;
}

template <class Scalar>
TOUCHSTONE_TARGET std::size_t solve_boxes(const PairTable<Scalar>& table, Task task) {
  if (task == Task::penetration) return solve_task<Scalar, Task::penetration>(table);
  if (task == Task::distance) return solve_task<Scalar, Task::distance>(table);
  return solve_task<Scalar, Task::intersect>(table);
}
