// Part of gjk-ray-cast-lanes, included by box_load.cpp for each level of vector instructions: what tells of two boxes
// before they fill a lane.
#include "algorithms/kernels/simd/quad_sums.inl"

// Four numbers are read where three are meant.
static_assert(offsetof(Motion, rotation_vector) == offsetof(Motion, displacement) + sizeof(Vec3d));
static_assert(offsetof(Shape, radii) == offsetof(Shape, half_extents) + sizeof(Vec3d));

// Whether all four numbers are below the limit in magnitude; false for NaN.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE QuadBits are_within(const Quad<double>& q, double limit) {
  return magnitudes(q) < Quad<double>{limit, limit, limit, limit};
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool are_nearly_rotations(const Pose& pose_a,
                                                              const Pose& pose_b) {
  constexpr double most_skew = 0.01;
  const QuadColumns of_a = columns_at(pose_a), of_b = columns_at(pose_b);
  const Quad<double> ax = three_of(of_a.x), ay = three_of(of_a.y), az = three_of(of_a.z);
  const Quad<double> bx = three_of(of_b.x), by = three_of(of_b.y), bz = three_of(of_b.z);
  const Quad<double> rotation{1, 1, 1, 0};
  const QuadBits all =
      are_within(sums_of(ax * ax, ay * ay, az * az, ax * ay) - rotation, most_skew) &
      are_within(sums_of(bx * bx, by * by, bz * bz, bx * by) - rotation, most_skew) &
      are_within(sums_of(ay * az, az * ax, by * bz, bz * bx), most_skew);
  return (all[0] & all[1] & all[2] & all[3]) != 0;
}

// Balls around the boxes stay apart if the square of the least distance of their centres is above
// that of the sum of their radii. Twice the squares' sum is no less. A matrix that is nearly a
// rotation lengthens by less than 1.015; the rest of 1.05 is for rounding, which is 1e-6 of the balls
// where lengths are below 1e9 of theirs.
TOUCHSTONE_TARGET LaneLoad ask_boxes(const Shape& a, const Pose& pose_a, const Motion& motion_a,
                                     const Shape& b, const Pose& pose_b, const Motion& motion_b,
                                     BoxLane& lane) {
  const Quad<double> offset = translation_between(pose_a, pose_b);
  const Quad<double> velocity =
      three_of(numbers_at(motion_b.displacement.data()) - numbers_at(motion_a.displacement.data()));
  const Quad<double> edges_a = three_of(numbers_at(a.half_extents.data()));
  const Quad<double> edges_b = three_of(numbers_at(b.half_extents.data()));
  const Quad<double> sums = sums_of(offset * offset, velocity * velocity,
                                    edges_a * edges_a + edges_b * edges_b, offset * velocity);
  const double away = sums[0], path = sums[1], reach = 2 * sums[2], towards = -sums[3];
  const double squares = away + path + reach;
  if (!(squares > 1e-200 && squares < 1e200) || !are_nearly_rotations(pose_a, pose_b)) {
    return LaneLoad::refused;
  }
  const double nearest = path > 0 ? std::clamp(towards / path, 0.0, 1.0) : 0;
  const Quad<double> there = offset + nearest * velocity;
  const Quad<double> terms = there * there;
  if (terms[0] + terms[1] + terms[2] > 1.05 * 1.05 * reach && away + path < 1e18 * reach) {
    return LaneLoad::miss;
  }
  std::memcpy(lane.columns_a, pose_a.rotation.data(), sizeof lane.columns_a);
  std::memcpy(lane.columns_b, pose_b.rotation.data(), sizeof lane.columns_b);
  std::memcpy(lane.extents_a, a.half_extents.data(), sizeof lane.extents_a);
  std::memcpy(lane.extents_b, b.half_extents.data(), sizeof lane.extents_b);
  std::memcpy(lane.offset, &offset, sizeof lane.offset);
  std::memcpy(lane.velocity, &velocity, sizeof lane.velocity);
  return LaneLoad::loaded;
}
