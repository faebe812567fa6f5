// Part of closed-form: the loops of round_pair_lanes.h. round_pair_lanes.cpp includes this file
// once for each level of vector instructions, inside that level's namespace.
#include "algorithms/kernels/batch/pair_lanes.inl"
#include "algorithms/kernels/simd/vector3.inl"

// The relation of two bodies' cores: metres, world axes, relative to the centre of a. The distance,
// negative if a point is in a solid, is between `lower` and `upper` up to `error`; `gap` is the
// distance along the normal.
template <class Scalar>
struct Cores {
  using Vector = typename Simd<Scalar>::Vector;
  Vector radius_a, radius_b;
  Vector gap, lower, upper, error;
  Vector3<Scalar> normal;  // unit vector from a to b
  Vector3<Scalar> on_a, on_b;
  unsigned usable;  // lanes that may be answered at all, as bits
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<Scalar>::Vector sum_of_sizes(
    const Vector3<Scalar>& v) {
  using Lanes = Simd<Scalar>;
  return Lanes::abs(v.x) + Lanes::abs(v.y) + Lanes::abs(v.z);
}

// number / square clamped to -1..1; zero if the square is zero.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<Scalar>::Vector parameter(
    typename Simd<Scalar>::Vector number, typename Simd<Scalar>::Vector square) {
  using Lanes = Simd<Scalar>;
  const auto one = Lanes::broadcast(1), zero = Lanes::broadcast(0);
  const auto some = Lanes::less(zero, square);
  const auto ratio = Lanes::select(some, number / square, zero);
  return Lanes::min(Lanes::max(ratio, -one), one);
}

// Removes v's component along a segment in the lanes whose parameter is inside the segment.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> part_across(
    const Vector3<Scalar>& v, const Vector3<Scalar>& along, typename Simd<Scalar>::Vector square,
    typename Simd<Scalar>::Vector at) {
  using Lanes = Simd<Scalar>;
  const auto zero = Lanes::broadcast(0);
  const auto inside = Lanes::less(Lanes::abs(at), Lanes::broadcast(1));
  const auto part = Lanes::select(Lanes::less(zero, square), dot<Scalar>(v, along) / square, zero);
  return moved<Scalar>(v, -Lanes::select(inside, part, zero), along);
}

// Segments around their centres; a sphere's is a point. Any points of the segments bound the
// distance from above, and any direction bounds it from below, so the closest points need no proof
// if the two bounds agree.
template <class Scalar, bool long_a, bool long_b>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void look_at_segments(const PairTable<Scalar>& table,
                                                          std::size_t begin, Cores<Scalar>& cores) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t width = Lanes::width;
  alignas(64) Quad<Scalar> offsets[width], sizes[width], axes_a[width], axes_b[width];
  Group<Scalar> group;
  start_group<Scalar>(table, begin, group);
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::uint32_t first = group.first[lane], second = group.second[lane];
    const Pose &a = table.pairs.poses[first], &b = table.pairs.poses[second];
    offsets[lane] = convert<Scalar>(pose_quad(b, 8) - pose_quad(a, 8));
    sizes[lane] = __builtin_shufflevector(shape_quad<Scalar>(table, first),
                                          shape_quad<Scalar>(table, second), 0, 1, 4, 5);
    if constexpr (long_a) axes_a[lane] = convert<Scalar>(pose_quad(a, 5));
    if constexpr (long_b) axes_b[lane] = convert<Scalar>(pose_quad(b, 5));
  }
  Vector offset_columns[4], size_columns[4], columns[4];
  columns_of<Scalar>(offsets, offset_columns);
  columns_of<Scalar>(sizes, size_columns);
  const Vector3<Scalar> offset{offset_columns[1], offset_columns[2], offset_columns[3]};
  const Vector zero = Lanes::broadcast(0);
  Vector3<Scalar> half_a{zero, zero, zero}, half_b{zero, zero, zero};
  if constexpr (long_a) {
    columns_of<Scalar>(axes_a, columns);
    half_a = moved<Scalar>(half_a, size_columns[1], {columns[1], columns[2], columns[3]});
  }
  if constexpr (long_b) {
    columns_of<Scalar>(axes_b, columns);
    half_b = moved<Scalar>(half_b, size_columns[3], {columns[1], columns[2], columns[3]});
  }
  cores.radius_a = size_columns[0];
  cores.radius_b = size_columns[2];
  const Vector size = cores.radius_a + cores.radius_b + sum_of_sizes<Scalar>(half_a) +
                      sum_of_sizes<Scalar>(half_b) + sum_of_sizes<Scalar>(offset);
  cores.usable = sized_lanes<Scalar>(size);
  cores.error = DistanceError<Scalar>::cores * size;

  // Parameters of the closest points, from -1 to 1.
  const Vector square_a = dot<Scalar>(half_a, half_a), square_b = dot<Scalar>(half_b, half_b);
  Vector s = zero, t = zero;
  if constexpr (long_a && long_b) {
    const Vector3<Scalar> across = cross<Scalar>(half_a, half_b);
    s = parameter<Scalar>(dot<Scalar>(cross<Scalar>(offset, half_b), across),
                          dot<Scalar>(across, across));
  }
  if constexpr (long_b) {
    t = parameter<Scalar>(
        dot<Scalar>(difference<Scalar>(moved<Scalar>({zero, zero, zero}, s, half_a), offset),
                    half_b),
        square_b);
  }
  if constexpr (long_a) {
    s = parameter<Scalar>(dot<Scalar>(moved<Scalar>(offset, t, half_b), half_a), square_a);
  }
  if constexpr (long_a && long_b) {
    t = parameter<Scalar>(
        dot<Scalar>(difference<Scalar>(moved<Scalar>({zero, zero, zero}, s, half_a), offset),
                    half_b),
        square_b);
  }
  cores.on_a = moved<Scalar>({zero, zero, zero}, s, half_a);
  cores.on_b = moved<Scalar>(offset, t, half_b);
  const Vector3<Scalar> between = difference<Scalar>(cores.on_b, cores.on_a);
  // The normal must be orthogonal to segments whose interior the points are in; rounding may tilt
  // it.
  Vector3<Scalar> straight = between;
  if constexpr (long_a) straight = part_across<Scalar>(straight, half_a, square_a, s);
  if constexpr (long_b) straight = part_across<Scalar>(straight, half_b, square_b, t);
  const Vector scale = Lanes::broadcast(1) / Lanes::sqrt(dot<Scalar>(straight, straight));
  cores.normal = {straight.x * scale, straight.y * scale, straight.z * scale};
  cores.gap = dot<Scalar>(cores.normal, between);
  cores.upper = Lanes::sqrt(dot<Scalar>(between, between));
  cores.lower = dot<Scalar>(cores.normal, offset) - Lanes::abs(dot<Scalar>(cores.normal, half_a)) -
                Lanes::abs(dot<Scalar>(cores.normal, half_b));
}

// Where a point lies to a solid: metres, in the solid's axes. outward * scale is a unit vector. It leads from a point
// outside to the nearest place of the surface, and from that place to a point inside.
template <class Scalar>
struct SolidGap {
  using Vector = typename Simd<Scalar>::Vector;
  Vector outward[3], scale;
  Vector gap;  // the distance; inside, minus the depth
};

// The solid is a box of these half extents, metres. A distance up to `rounding` has no digits left in its square, so
// that the point counts as inside.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void look_from_box(const typename Simd<Scalar>::Vector at[3],
                                                       const typename Simd<Scalar>::Vector half[3],
                                                       typename Simd<Scalar>::Vector rounding,
                                                       SolidGap<Scalar>& solid) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  // The part outside the box, and the way out if inside.
  Vector outside[3], inward[3];
  Vector least = Lanes::broadcast(-std::numeric_limits<Scalar>::infinity());
  for (int k = 0; k < 3; ++k) {
    const Vector beyond = Lanes::abs(at[k]) - half[k];
    const Vector sign = Lanes::select(Lanes::less(at[k], zero), -one, one);
    outside[k] = sign * Lanes::max(beyond, zero);
    // The way out leads through the nearest face, the first of several.
    const auto nearer = Lanes::less(least, beyond);
    least = Lanes::max(beyond, least);
    for (int other = 0; other < k; ++other) {
      inward[other] = Lanes::select(nearer, zero, inward[other]);
    }
    inward[k] = Lanes::select(nearer, sign, zero);
  }
  const Vector distance =
      Lanes::sqrt(outside[0] * outside[0] + outside[1] * outside[1] + outside[2] * outside[2]);
  const auto is_outside = Lanes::less(rounding, distance);
  solid.scale = -one / Lanes::select(is_outside, distance, one);
  solid.gap = Lanes::select(is_outside, distance, least);
  for (int k = 0; k < 3; ++k) solid.outward[k] = Lanes::select(is_outside, outside[k], inward[k]);
}

// The solid is a cylinder or a cone around z, with this radius and half length in metres: a rectangle or a triangle
// in the half plane through the point and the axis. `rounding` is as for a box.
template <class Scalar, bool cone>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void look_from_revolved(
    const typename Simd<Scalar>::Vector at[3], typename Simd<Scalar>::Vector radius,
    typename Simd<Scalar>::Vector half, typename Simd<Scalar>::Vector rounding,
    SolidGap<Scalar>& solid) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const Vector from_axis = Lanes::sqrt(at[0] * at[0] + at[1] * at[1]);
  // Within rounding of the axis any direction serves.
  const auto is_off = Lanes::less(rounding, from_axis);
  const Vector over = one / Lanes::select(is_off, from_axis, one);
  const Vector x = Lanes::select(is_off, at[0] * over, one);
  const Vector y = Lanes::select(is_off, at[1] * over, zero);
  Vector out, up, length;  // `out` and `up` have this length
  if constexpr (cone) {
    // From the rim of the base to the tip, upwards if these are one within rounding.
    const Vector slant = Lanes::sqrt(radius * radius + Lanes::broadcast(4) * half * half);
    const auto is_long = Lanes::less(rounding, slant);
    const Vector over_slant = one / Lanes::select(is_long, slant, one);
    const Vector along_out = Lanes::select(is_long, -radius * over_slant, zero);
    const Vector along_up = Lanes::select(is_long, Lanes::broadcast(2) * half * over_slant, one);
    const Vector from_rim = from_axis - radius, from_base = at[2] + half, from_tip = at[2] - half;
    const Vector side = from_rim * along_up - from_base * along_out;
    const auto off_tip =
        Lanes::less(rounding, Lanes::max(Lanes::abs(from_axis), Lanes::abs(from_tip)));
    const auto off_rim =
        Lanes::less(rounding, Lanes::max(Lanes::abs(from_rim), Lanes::abs(from_base)));
    const auto at_tip =
        both(off_tip, Lanes::less(zero, from_axis * along_out + from_tip * along_up));
    const auto before_rim = Lanes::less(from_rim * along_out + from_base * along_up, zero);
    const auto at_rim = both(off_rim, both(before_rim, Lanes::less(zero, from_rim)));
    const auto at_side = Lanes::less(-from_base, side);
    const auto at_point = either(at_tip, at_rim);
    out = Lanes::select(at_side, along_up, zero);
    up = Lanes::select(at_side, -along_out, -one);
    out = Lanes::select(at_rim, from_rim, Lanes::select(at_tip, from_axis, out));
    up = Lanes::select(at_rim, from_base, Lanes::select(at_tip, from_tip, up));
    const Vector distance = Lanes::sqrt(out * out + up * up);
    length = Lanes::select(at_point, distance, one);
    solid.gap = Lanes::select(at_point, distance, Lanes::max(side, -from_base));
  } else {
    const Vector beyond_side = from_axis - radius, beyond_end = Lanes::abs(at[2]) - half;
    const Vector sign = Lanes::select(Lanes::less(at[2], zero), -one, one);
    const Vector outside = Lanes::max(beyond_side, zero), above = Lanes::max(beyond_end, zero);
    const Vector distance = Lanes::sqrt(outside * outside + above * above);
    const auto is_outside = Lanes::less(rounding, distance);
    const auto by_side = Lanes::less(beyond_end, beyond_side);
    out = Lanes::select(is_outside, outside, Lanes::select(by_side, one, zero));
    up = sign * Lanes::select(is_outside, above, Lanes::select(by_side, zero, one));
    length = Lanes::select(is_outside, distance, one);
    solid.gap = Lanes::select(is_outside, distance, Lanes::max(beyond_side, beyond_end));
  }
  solid.outward[0] = out * x;
  solid.outward[1] = out * y;
  solid.outward[2] = up;
  solid.scale = -one / length;
}

// The relation of a point, the centre of a, and a box, cylinder or cone.
template <class Scalar, ShapeKind kind>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void look_at_solid(const PairTable<Scalar>& table,
                                                       std::size_t begin, Cores<Scalar>& cores) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t width = Lanes::width;
  alignas(64) Quad<Scalar> quads[4][width];
  Group<Scalar> group;
  start_group<Scalar>(table, begin, group);
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::uint32_t first = group.first[lane], second = group.second[lane];
    const Pose &a = table.pairs.poses[first], &b = table.pairs.poses[second];
    const Quad<double> end = pose_quad(b, 8), between = end - pose_quad(a, 8);
    quads[0][lane] = convert<Scalar>(pose_quad(b, 0));
    quads[1][lane] = convert<Scalar>(pose_quad(b, 4));
    quads[2][lane] = convert<Scalar>(__builtin_shufflevector(end, between, 0, 5, 6, 7));
    quads[3][lane] = __builtin_shufflevector(shape_quad<Scalar>(table, second),
                                             shape_quad<Scalar>(table, first), 0, 1, 2, 4);
  }
  Vector columns[4][4];
  for (std::size_t k = 0; k < 4; ++k) columns_of<Scalar>(quads[k], columns[k]);
  const Vector3<Scalar> edges[3] = {{columns[0][0], columns[0][1], columns[0][2]},
                                    {columns[0][3], columns[1][0], columns[1][1]},
                                    {columns[1][2], columns[1][3], columns[2][0]}};
  const Vector3<Scalar> offset{columns[2][1], columns[2][2], columns[2][3]};
  // The half extents of a box, else radius, half length and zero.
  const Vector sizes[3] = {columns[3][0], columns[3][1], columns[3][2]};
  const Vector zero = Lanes::broadcast(0);
  cores.radius_a = columns[3][3];
  cores.radius_b = zero;
  const Vector size =
      cores.radius_a + sizes[0] + sizes[1] + sizes[2] + sum_of_sizes<Scalar>(offset);
  const Vector rounding = Lanes::broadcast(unit_roundoff<Scalar>) * size;
  const Vector at[3] = {-dot<Scalar>(edges[0], offset), -dot<Scalar>(edges[1], offset),
                        -dot<Scalar>(edges[2], offset)};
  SolidGap<Scalar> solid;
  if constexpr (kind == ShapeKind::box) {
    cores.error = DistanceError<Scalar>::box * size;
    look_from_box<Scalar>(at, sizes, rounding, solid);
  } else {
    cores.error = DistanceError<Scalar>::revolved * size;
    look_from_revolved<Scalar, kind == ShapeKind::cone>(at, sizes[0], sizes[1], rounding, solid);
  }
  cores.usable = sized_lanes<Scalar>(size) & orthonormal_lanes<Scalar>(edges);
  cores.normal = {zero, zero, zero};
  for (int k = 0; k < 3; ++k)
    cores.normal = moved<Scalar>(cores.normal, solid.outward[k] * solid.scale, edges[k]);
  cores.gap = solid.gap;
  cores.lower = cores.gap;
  cores.upper = cores.gap;
  cores.on_a = {zero, zero, zero};
  cores.on_b = moved<Scalar>({zero, zero, zero}, cores.gap, cores.normal);
}

template <class Scalar, ShapeKind kind_a, ShapeKind kind_b>
TOUCHSTONE_TARGET std::size_t solve_cores(const PairTable<Scalar> table, Task task) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const bool distances = asks_distance(task), depths = asks_depth(task);
  std::size_t left = 0;
  for (std::size_t begin = 0; begin < table.pairs.first.size(); begin += Lanes::width) {
    Cores<Scalar> cores;
    if constexpr (kind_b < ShapeKind::box) {
      look_at_segments<Scalar, kind_a == ShapeKind::capsule, kind_b == ShapeKind::capsule>(
          table, begin, cores);
    } else {
      look_at_solid<Scalar, kind_b>(table, begin, cores);
    }
    const Vector radii = cores.radius_a + cores.radius_b;
    unsigned apart = cores.usable & Lanes::to_bits(Lanes::less(cores.error, cores.lower - radii));
    unsigned overlapping =
        cores.usable & Lanes::to_bits(Lanes::less(cores.upper - radii, -cores.error));
    unsigned asked = (distances ? apart : 0) | (depths ? overlapping : 0);
    if (asked != 0) {
      // If the bounds are farther apart than this, the normal is not the shortest way.
      const unsigned unsound =
          asked & ~Lanes::to_bits(Lanes::less(cores.upper - cores.lower, cores.error));
      asked &= ~unsound;
      apart &= ~unsound;
      overlapping &= ~unsound;
      const Vector3<Scalar>& normal = cores.normal;
      write_numbers<Scalar>(
          table, begin, asked,
          {cores.gap - radii, cores.lower - radii - cores.error, cores.upper - radii + cores.error,
           normal, moved<Scalar>(cores.on_a, cores.radius_a, normal),
           moved<Scalar>(cores.on_b, -cores.radius_b, normal)});
    }
    left = write_answers<Scalar>(table, begin, apart, overlapping, left);
  }
  return left;
}

template <class Scalar>
TOUCHSTONE_TARGET std::size_t solve_round(const PairTable<Scalar>& table, ShapeKind kind_a,
                                          ShapeKind kind_b, Task task) {
  using enum ShapeKind;
  if (kind_b == box) return solve_cores<Scalar, sphere, box>(table, task);
  if (kind_b == cylinder) return solve_cores<Scalar, sphere, cylinder>(table, task);
  if (kind_b == cone) return solve_cores<Scalar, sphere, cone>(table, task);
  if (kind_a == capsule) return solve_cores<Scalar, capsule, capsule>(table, task);
  if (kind_b == capsule) return solve_cores<Scalar, sphere, capsule>(table, task);
  return solve_cores<Scalar, sphere, sphere>(table, task);
}
