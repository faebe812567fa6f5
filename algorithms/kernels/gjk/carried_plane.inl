// The test of carried_plane.h in vectors of four numbers. carried_plane.cpp includes this file once
// for each level of vector instructions, inside that level's namespace.

#include "algorithms/kernels/simd/quad_sums.inl"

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> kept_at(const std::byte* plane,
                                                         std::size_t first) {
  Quad<float> q;
  std::memcpy(&q, plane + first * sizeof(float), sizeof q);
  return widen<float>(q);
}

// With n the normal as a carries it into the world, and d_a, d_b the differences of n seen from
// either body from what the body carries, the gap along n is at least
//   n . offset - reach - (|n| - 1) balls - radius_a |d_a| - radius_b |d_b|,
// where the balls are those that round the bodies' cores: they are part of the radii. Instead of
// the roots, x + y < g is tested by 2 (x^2 + y^2) < g^2.
TOUCHSTONE_TARGET bool parts_at(const CarriedPlane& carried, const Pose& pose_a, const Pose& pose_b,
                                double margin) {
  const auto* const plane = reinterpret_cast<const std::byte*>(&carried);
  using Numbers = Quad<double>;
  constexpr double rounding = CarriedPlane::rounding;
  const QuadColumns a = columns_at(pose_a), b = columns_at(pose_b);
  const Numbers in_a = kept_at(plane, 0), in_b = kept_at(plane, 3);
  const Numbers normal = three_of(a.x * __builtin_shufflevector(in_a, in_a, 0, 0, 0, 0) +
                                  a.y * __builtin_shufflevector(in_a, in_a, 1, 1, 1, 1) +
                                  a.z * __builtin_shufflevector(in_a, in_a, 2, 2, 2, 2));
  const Numbers offset = translation_between(pose_a, pose_b);
  const Numbers from_a = seen_from(a, normal, offset * normal);
  const Numbers from_b = seen_from(b, normal, normal * normal);

  const Numbers lengths = kept_at(plane, 5);  // the last of in_b before them
  const double reach = lengths[1], radius_a = lengths[2], radius_b = lengths[3];
  const Numbers off_a = (from_a - in_a) * __builtin_shufflevector(lengths, lengths, 2, 2, 2, 2);
  const Numbers off_b = (from_b - in_b) * __builtin_shufflevector(lengths, lengths, 3, 3, 3, 3);
  const Numbers sums = paired_sums(three_of(off_a * off_a + off_b * off_b), magnitudes(offset));
  const double bend = sums[0] + sums[2], length = sums[1] + sums[3];
  const double excess = from_b[3] - 1;
  const double gap = from_a[3] - reach - (radius_a + radius_b + margin) * std::abs(excess) -
                     2 * rounding * length - margin;
  return gap > 0 && gap * gap > 2 * (1 + rounding) * bend && excess < 1 && are_below_two(a, b) &&
         carried.is_own();
}
