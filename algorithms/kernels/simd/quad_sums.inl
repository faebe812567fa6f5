// Numbers of a pose and sums over them, in vectors of four. Used by carried_plane, first_plane,
// stretch and casts of boxes, which include this file once for each level of vector instructions.

using QuadBits __attribute__((vector_size(32))) = std::int64_t;

// The pose has a number behind each column of its matrix, and one before its translation, so that
// four may be read where three are meant.
static_assert(offsetof(Pose, translation) == 9 * sizeof(double));
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> numbers_at(const double* from) {
  Quad<double> q;
  std::memcpy(&q, from, sizeof q);
  return q;
}

// Zero in place of the fourth number.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> three_of(const Quad<double>& q) {
  const QuadBits mask{-1, -1, -1, 0};
  return bit_cast<Quad<double>>(bit_cast<QuadBits>(q) & mask);
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> magnitudes(const Quad<double>& q) {
  return bit_cast<Quad<double>>(bit_cast<QuadBits>(q) & ~bit_cast<QuadBits>(-Quad<double>{}));
}

// Sums of neighbours: two of x, then two of y, in the order x, y, x, y.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> paired_sums(const Quad<double>& x,
                                                             const Quad<double>& y) {
  return __builtin_shufflevector(x, y, 0, 4, 2, 6) + __builtin_shufflevector(x, y, 1, 5, 3, 7);
}
// The sums of the four numbers of each.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> sums_of(const Quad<double>& x,
                                                         const Quad<double>& y,
                                                         const Quad<double>& z,
                                                         const Quad<double>& w) {
  const Quad<double> of_xy = paired_sums(x, y), of_zw = paired_sums(z, w);
  return __builtin_shufflevector(of_xy, of_zw, 0, 1, 6, 7) +
         __builtin_shufflevector(of_xy, of_zw, 2, 3, 4, 5);
}

// The matrix of a pose by its columns. The fourth number of each is another one of the pose.
struct QuadColumns {
  Quad<double> x, y, z;
};
TOUCHSTONE_TARGET TOUCHSTONE_INLINE QuadColumns columns_at(const Pose& pose) {
  const double* const from = pose.rotation.data();
  return {numbers_at(from), numbers_at(from + 3), numbers_at(from + 6)};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> translation_between(const Pose& a, const Pose& b) {
  const Quad<double> between =
      numbers_at(b.rotation.data() + 8) - numbers_at(a.rotation.data() + 8);
  return three_of(__builtin_shufflevector(between, between, 1, 2, 3, 0));
}
// The products of a vector with the columns, and the sum of `w` as the fourth number.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> seen_from(const QuadColumns& columns,
                                                           const Quad<double>& vector,
                                                           const Quad<double>& w) {
  return sums_of(columns.x * vector, columns.y * vector, columns.z * vector, w);
}
// Whether all entries of both matrices are below two in magnitude: none has the highest bit of a
// double's exponent.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool are_below_two(const QuadColumns& a, const QuadColumns& b) {
  const QuadBits bits = bit_cast<QuadBits>(a.x) | bit_cast<QuadBits>(a.y) |
                        bit_cast<QuadBits>(a.z) | bit_cast<QuadBits>(b.x) |
                        bit_cast<QuadBits>(b.y) | bit_cast<QuadBits>(b.z);
  return ((bits[0] | bits[1] | bits[2]) >> 62 & 1) == 0;
}
