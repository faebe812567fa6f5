// The gaps of box_planes.h along all axes, on vectors of four numbers of which three are used. box_planes.cpp includes
// this file once for each level of vector instructions, inside that level's namespace. Results are equal at every level.

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> quad(const Vec3d& v) {
  return Quad<double>{v.x(), v.y(), v.z(), 0};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> size_of(const Quad<double>& q) {
  return q < 0 ? -q : q;
}
// `value` with the sign changed where `sign` is negative.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> along(const Quad<double>& sign,
                                                       const Quad<double>& value) {
  return sign < 0 ? -value : value;
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE double dot(const Quad<double>& a, const Quad<double>& b) {
  const Quad<double> products = a * b;
  return products[0] + products[1] + products[2];
}
// For lane j, what is wanted of the next two lanes: a[j + 1] b[j + 2] + a[j + 2] b[j + 1].
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> others(const Quad<double>& a,
                                                        const Quad<double>& b) {
  const Quad<double> a1 = __builtin_shufflevector(a, a, 1, 2, 0, 3),
                     a2 = __builtin_shufflevector(a, a, 2, 0, 1, 3);
  const Quad<double> b1 = __builtin_shufflevector(b, b, 1, 2, 0, 3),
                     b2 = __builtin_shufflevector(b, b, 2, 0, 1, 3);
  return a1 * b2 + a2 * b1;
}

TOUCHSTONE_TARGET void measure_at(const Box& a, const Box& b, const BoxRates& rates, Gaps& gaps) {
  using Vector = Quad<double>;
  const Vector p = quad(a.extents), q = quad(b.extents);
  // Column i is axis i, in the world; row i has coordinate i of all axes.
  Vector of_a[3], rows_a[3], rows_b[3];
  for (int i = 0; i < 3; ++i) {
    of_a[i] = a.per_column * quad(a.matrix.col(i));
    rows_a[i] = a.per_column * Vector{a.matrix(i, 0), a.matrix(i, 1), a.matrix(i, 2), 0};
    rows_b[i] = b.per_column * Vector{b.matrix(i, 0), b.matrix(i, 1), b.matrix(i, 2), 0};
  }
  const auto seen = [](const Vector(&rows)[3], const Vec3d& v) TOUCHSTONE_TARGET -> Vector {
    return rows[0] * v.x() + rows[1] * v.y() + rows[2] * v.z();
  };
  // The offset and its rate as seen from a and from b.
  const Vector c = seen(rows_a, rates.offset), v = seen(rows_a, rates.offset_rate_a);
  const Vector d = seen(rows_b, rates.offset), w = seen(rows_b, rates.offset_rate_b);
  const Vector turn = seen(rows_a, rates.turn);
  // The axes of b as seen from a, a row for each of a, and their rates.
  Vector m[3], rate[3], size[3], size_rate[3];
  for (int i = 0; i < 3; ++i) {
    m[i] = rows_b[0] * of_a[i][0] + rows_b[1] * of_a[i][1] + rows_b[2] * of_a[i][2];
  }
  Vector reach = Vector{}, reach_rate = Vector{};  // of b along the axes of a
  for (int i = 0; i < 3; ++i) {
    const int k = next(i), l = next(k);
    rate[i] = turn[k] * m[l] - turn[l] * m[k];
    size[i] = size_of(m[i]);
    size_rate[i] = along(m[i], rate[i]);
    reach[i] = dot(size[i], q);
    reach_rate[i] = dot(size_rate[i], q);
  }
  const auto set = [&](int row, const Vector& sense, const Vector& gap, const Vector& closing,
                       const Vector& square) TOUCHSTONE_TARGET {
    gaps.sense[row] = sense;
    gaps.gap[row] = gap;
    gaps.square[row] = square;
    constexpr double least_rate = 1e-3;  // a gap that hardly closes lasts for as long as it is wide
    const Vector slow = least_rate * gap;
    const Vector lasts = gap / (closing > slow ? closing : slow);
    const Vector none = Vector{} - 1;
    const Vector wide = gaps.least * gaps.least * square;
    gaps.lasts[row] =
        ((gap > 0) & (gap * gap > wide) & (square > nearly_parallel_square)) ? lasts : none;
  };
  const Vector ones = Vector{} + 1;
  set(0, c, size_of(c) - p - reach, reach_rate - along(c, v), ones);
  set(1, d, size_of(d) - q - (p[0] * size[0] + p[1] * size[1] + p[2] * size[2]),
      p[0] * size_rate[0] + p[1] * size_rate[1] + p[2] * size_rate[2] - along(d, w), ones);
  for (int i = 0; i < 3; ++i) {
    const int k = next(i), l = next(k);
    const Vector across = c[l] * m[k] - c[k] * m[l];
    const Vector change = v[l] * m[k] + c[l] * rate[k] - v[k] * m[l] - c[k] * rate[l];
    set(2 + i, across, size_of(across) - p[k] * size[l] - p[l] * size[k] - others(q, size[i]),
        p[k] * size_rate[l] + p[l] * size_rate[k] + others(q, size_rate[i]) - along(across, change),
        m[k] * m[k] + m[l] * m[l]);
  }
}
