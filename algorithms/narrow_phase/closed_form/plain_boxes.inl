// The fifteen axes of plain_boxes.h in vectors of eight numbers: three for box a, three for box b.
// plain_boxes.cpp includes this file once for each level of vector instructions, inside that
// level's namespace.

// Numbers 0 to 2 belong to the axes of box a, 4 to 6 to those of box b. The others are not used.
template <class Scalar>
using Both __attribute__((vector_size(8 * sizeof(Scalar)))) = Scalar;

// Numbers i, j and k of both boxes.
template <int i, int j, int k, class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector turned(const Vector& x) {
  return __builtin_shufflevector(x, x, i, j, k, 3, 4 + i, 4 + j, 4 + k, 7);
}
template <class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector swapped(const Vector& x) {
  return __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3);
}
template <int k, class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector all_of(const Vector& x) {
  return turned<k, k, k>(x);
}
template <class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector absolute(const Vector& x) {
  using Bits = decltype(x < x);
  return bit_cast<Vector>(bit_cast<Bits>(x) & ~bit_cast<Bits>(-Vector{}));
}
template <class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector greater(const Vector& x, const Vector& y) {
  return x > y ? x : y;
}
template <class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE auto greatest(const Vector& x) {
  const auto most = x[0] > x[1] ? x[0] : x[1];
  return most > x[2] ? most : x[2];
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Both<Scalar> both(const double* a, const double* b) {
  Quad<double> from_a, from_b;
  std::memcpy(&from_a, a, sizeof from_a);
  std::memcpy(&from_b, b, sizeof from_b);
  const Quad<Scalar> own_a = __builtin_convertvector(from_a, Quad<Scalar>);
  const Quad<Scalar> own_b = __builtin_convertvector(from_b, Quad<Scalar>);
  return __builtin_shufflevector(own_a, own_b, 0, 1, 2, 3, 4, 5, 6, 7);
}

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Answer meet_in(const Shape& shape_a, const Pose& pose_a,
                                                   const Shape& shape_b, const Pose& pose_b) {
  using Vector = Both<Scalar>;
  // Four numbers are read where three are meant: those behind a column and behind the half extents
  // belong to the pose and the shape, too, and so does the one before the translation.
  static_assert(offsetof(Pose, translation) == 9 * sizeof(double));
  static_assert(offsetof(Shape, radii) == offsetof(Shape, half_extents) + 3 * sizeof(double));
  const double *const a = pose_a.rotation.data(), *const b = pose_b.rotation.data();
  const Vector x = both<Scalar>(a, b), y = both<Scalar>(a + 3, b + 3);
  const Vector z = both<Scalar>(a + 6, b + 6);
  const Vector half = both<Scalar>(shape_a.half_extents.data(), shape_b.half_extents.data());
  Quad<double> from, to;
  std::memcpy(&from, a + 8, sizeof from);
  std::memcpy(&to, b + 8, sizeof to);
  const Quad<Scalar> centre = __builtin_convertvector(to - from, Quad<Scalar>);
  const Vector offset = __builtin_shufflevector(centre, centre, 1, 2, 3, 0, 1, 2, 3, 0);

  // Rows of the matrices: number i belongs to axis i.
  const Vector even = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13);
  const Vector odd = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15);
  const Vector row_0 = __builtin_shufflevector(even, z, 0, 1, 8, 8, 4, 5, 12, 12);
  const Vector row_1 = __builtin_shufflevector(even, z, 2, 3, 9, 9, 6, 7, 13, 13);
  const Vector row_2 = __builtin_shufflevector(odd, z, 0, 1, 10, 10, 4, 5, 14, 14);
  const auto times = [&](const Vector& v) TOUCHSTONE_TARGET {
    return row_0 * all_of<0>(v) + row_1 * all_of<1>(v) + row_2 * all_of<2>(v);
  };
  // How far each box extends along its own axes, and along those of the other.
  const Vector squares = row_0 * row_0 + row_1 * row_1 + row_2 * row_2;
  const Vector skews = absolute(row_0 * turned<1, 2, 0>(row_0) + row_1 * turned<1, 2, 0>(row_1) +
                                row_2 * turned<1, 2, 0>(row_2));
  const Vector half_1 = turned<1, 2, 0>(half), half_2 = turned<2, 0, 1>(half);
  const Vector own = squares * half + skews * half_1 + turned<2, 0, 1>(skews) * half_2;
  const Vector other = swapped(half);
  const Vector turn_0 = times(swapped(x)), turn_1 = times(swapped(y)), turn_2 = times(swapped(z));
  const Vector positive_0 = absolute(turn_0), positive_1 = absolute(turn_1),
               positive_2 = absolute(turn_2);
  const Vector along = times(offset);
  const Vector gaps = absolute(along) - own -
                      (positive_0 * all_of<0>(other) + positive_1 * all_of<1>(other) +
                       positive_2 * all_of<2>(other));

  // The sum of all lengths.
  const Vector lengths = absolute(offset) + half + other;
  const Scalar size = lengths[0] + lengths[1] + lengths[2];
  const Scalar error = gap_rounding<Scalar> * size;
  const Vector face_gaps = greater(gaps, swapped(gaps));
  const Vector off = greater(absolute(squares - 1), skews);
  const Scalar skew = greatest(greater(off, swapped(off)));
  const Scalar face_gap = greatest(face_gaps);
  if (!(size > least_size<Scalar> && size < 1 / least_size<Scalar> && skew < Scalar(0.01)))
    return Answer::unknown;
  if (face_gap > error) return Answer::separated;

  // Gaps along products of edges, which are shorter than 1, for rotations alone. Numbers 0 to 2
  // belong to the axes of box a, times one of box b.
  const Vector along_1 = turned<1, 2, 0>(along), along_2 = turned<2, 0, 1>(along);
  const auto edges = [&](const Vector& turn, const Vector& positive,
                         const Vector& by_b) TOUCHSTONE_TARGET {
    return absolute(along_2 * turned<1, 2, 0>(turn) - along_1 * turned<2, 0, 1>(turn)) -
           (half_1 * turned<2, 0, 1>(positive) + half_2 * turned<1, 2, 0>(positive)) - by_b;
  };
  const Vector half_b0 = all_of<0>(other), half_b1 = all_of<1>(other), half_b2 = all_of<2>(other);
  const Vector edges_0 = edges(turn_0, positive_0, half_b1 * positive_2 + half_b2 * positive_1);
  const Vector edges_1 = edges(turn_1, positive_1, half_b2 * positive_0 + half_b0 * positive_2);
  const Vector edges_2 = edges(turn_2, positive_2, half_b0 * positive_1 + half_b1 * positive_0);
  const Scalar edge_gap = greatest(greater(greater(edges_0, edges_1), edges_2));
  if (edge_gap > 4 * error) {
    const auto gap = [&](int i, int j) {
      return static_cast<double>(j == 0 ? edges_0[i] : j == 1 ? edges_1[i] : edges_2[i]);
    };
    return apart_along_edges(shape_a, pose_a, shape_b, pose_b, gap);
  }
  const Scalar most_parallel = greatest(greater(greater(positive_0, positive_1), positive_2));
  const bool edges_tell = 1 - most_parallel * most_parallel > parallel<Scalar> * parallel<Scalar>;
  const Scalar margin = error + 16 * skew * size;
  const bool meet = edges_tell ? std::max(face_gap, edge_gap) < -margin
                               : face_gap < -(margin + 4 * parallel<Scalar> * size);
  return meet ? Answer::overlapping : Answer::unknown;
}

template <class Scalar>
TOUCHSTONE_TARGET Answer meet_plain_boxes(const Shape& a, const Pose& pose_a, const Shape& b,
                                          const Pose& pose_b) {
  return meet_in<Scalar>(a, pose_a, b, pose_b);
}
