// The plane of first_plane.h. first_plane.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.

#include "algorithms/kernels/simd/quad_sums.inl"

// How far the core reaches along a direction in its own axes, in its unit, and its corner there.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE hull_scan::Found<Scalar> reach_at(
    const SupportShape<Scalar>& shape, Scalar x, Scalar y, Scalar z) {
  if (shape.core == SupportCore::hull) {
    const std::span<const hull_scan::VertexBlock<Scalar>> blocks(shape.vertices);
    return furthest_at(blocks, x, y, z);
  }
  const auto negative = [](Scalar d) { return std::uint32_t{std::signbit(d)}; };
  const Vec3<Scalar>& e = shape.extents;
  return {std::abs(x) * e.x() + std::abs(y) * e.y() + std::abs(z) * e.z(),
          negative(x) | negative(y) << 1 | negative(z) << 2};
}

// With n the offset of the centres, a corner v of a core in its unit, |v| <= 1, and a matrix R whose
// entries are below two, n . R v is the product of v with R^T n, which is at most 6 |n|. In units of u
// and of |n| times the unit, rounding takes 18 of R^T n in double and 6 in the scalar, 18 of the
// product, 6 of v, 7 of the sums, and up to 30 of the offset, with what its doubt says: less than 128.
template <class Scalar>
TOUCHSTONE_TARGET FirstPlane first_plane_at(const CentreOffset& offset,
                                            const SupportShape<Scalar>& a, const Pose& pose_a,
                                            const SupportShape<Scalar>& b, const Pose& pose_b) {
  using Numbers = Quad<double>;
  constexpr double rounding = 64 * std::numeric_limits<Scalar>::epsilon();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Products of shorter offsets lose digits; those of long ones overflow, and the gap with them.
  constexpr double shortest = sizeof(Scalar) == 8 ? 1e-140 : 1e-30;
  const QuadColumns columns_a = columns_at(pose_a), columns_b = columns_at(pose_b);
  const Numbers normal{offset.vector.x(), offset.vector.y(), offset.vector.z(), 0};
  const Numbers in_a = seen_from(columns_a, normal, normal * normal);
  const Numbers in_b = seen_from(columns_b, normal, magnitudes(normal));
  const auto own = [](double x) { return static_cast<Scalar>(x); };
  const auto of_a = reach_at(a, own(in_a[0]), own(in_a[1]), own(in_a[2]));
  const auto of_b = reach_at(b, -own(in_b[0]), -own(in_b[1]), -own(in_b[2]));
  // Times the length of the offset.
  const double gap =
      in_a[3] - a.unit * static_cast<double>(of_a.value) - b.unit * static_cast<double>(of_b.value);
  const double length = in_b[3];
  const double lost = (rounding * (length + a.unit + b.unit) + 2 * offset.doubt) * length;
  const bool parts =
      gap > lost && gap < infinity && length > shortest && are_below_two(columns_a, columns_b);
  return {parts, {of_a.index, of_b.index}};
}
