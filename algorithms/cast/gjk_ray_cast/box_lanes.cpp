// Part of gjk-ray-cast-lanes: loads lanes, and selects the level of vector instructions.
#include "algorithms/cast/gjk_ray_cast/box_lanes.h"

#include <algorithm>
#include <bit>
#include <concepts>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/motion/relative_motion.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/cast/gjk_ray_cast/box_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

bool is_nearly_rotation(const Mat3d& matrix) {
  for (int k = 0; k < 3; ++k) {
    const double square = matrix.col(k).squaredNorm();
    const double skew = matrix.col(k).dot(matrix.col((k + 1) % 3));
    if (!(square > 0.99 && square < 1.01 && skew > -0.01 && skew < 0.01)) return false;
  }
  return true;
}

// Returns true if balls around boxes with these half edges stay apart. A matrix that is nearly a rotation
// lengthens by less than 1.015; the rest of 1.05 is for rounding, which is 1e-6 of the balls where lengths
// are below 1e9 of theirs. Twice the squares' sum is above the square of the radii's sum.
bool balls_pass(const Vec3d& offset, const Vec3d& velocity, const Vec3d& extents_a,
                const Vec3d& extents_b) {
  const double reach = 2 * (extents_a.squaredNorm() + extents_b.squaredNorm());
  const Vec3d there = offset + nearest_time(offset, velocity) * velocity;
  return there.squaredNorm() > 1.05 * 1.05 * reach &&
         offset.squaredNorm() + velocity.squaredNorm() < 1e18 * reach;
}

}  // namespace

LaneLoad load_box_lane(const Shape& a, const Pose& pose_a, const Motion& motion_a, const Shape& b,
                       const Pose& pose_b, const Motion& motion_b, BoxLane& lane) {
  const Vec3d offset = pose_b.translation - pose_a.translation;
  const Vec3d velocity = motion_b.displacement - motion_a.displacement;
  const double greatest = std::max({offset.cwiseAbs().maxCoeff(), velocity.cwiseAbs().maxCoeff(),
                                    a.half_extents.maxCoeff(), b.half_extents.maxCoeff()});
  if (!(greatest > 1e-100 && greatest < 1e100) || !is_nearly_rotation(pose_a.rotation) ||
      !is_nearly_rotation(pose_b.rotation)) {
    return LaneLoad::refused;
  }
  if (balls_pass(offset, velocity, a.half_extents, b.half_extents)) return LaneLoad::miss;
  for (int k = 0; k < 3; ++k) {
    for (int row = 0; row < 3; ++row) {
      lane.columns_a[3 * k + row] = pose_a.rotation(row, k);
      lane.columns_b[3 * k + row] = pose_b.rotation(row, k);
    }
    lane.extents_a[k] = a.half_extents[k];
    lane.extents_b[k] = b.half_extents[k];
    lane.offset[k] = offset[k];
    lane.velocity[k] = velocity[k];
  }
  return LaneLoad::loaded;
}

void cast_boxes(std::span<const BoxLane> lanes, std::span<LaneTimes> times) {
  switch (isa()) {
    case Isa::avx512: return avx512::cast_all_lanes(lanes, times);
    case Isa::avx2: return avx2::cast_all_lanes(lanes, times);
    case Isa::baseline: break;
  }
  baseline::cast_all_lanes(lanes, times);
}

}  // namespace touchstone
