// Part of gjk-ray-cast-lanes: loads lanes of round bodies, and selects the level of vector instructions.
#include "algorithms/cast/gjk_ray_cast/round_lanes.h"

#include <algorithm>
#include <concepts>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/cast/gjk_ray_cast/round_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

LaneLoad load_round_lane(const Shape& a, const Pose& pose_a, const Motion& motion_a, const Shape& b,
                         const Pose& pose_b, const Motion& motion_b, RoundLane& lane) {
  const Vec3d offset = pose_b.translation - pose_a.translation;
  const Vec3d velocity = motion_b.displacement - motion_a.displacement;
  const auto side = [](const Shape& shape, const Pose& pose) -> Vec3d {
    if (shape.kind != ShapeKind::capsule) return Vec3d::Zero();
    return shape.half_length * pose.rotation.col(2);
  };
  const Vec3d side_a = side(a, pose_a), side_b = side(b, pose_b);
  double greatest = a.radius + b.radius;
  for (int k = 0; k < 3; ++k) {
    lane.side_a[k] = side_a[k];
    lane.side_b[k] = side_b[k];
    lane.offset[k] = offset[k];
    lane.velocity[k] = velocity[k];
    greatest = std::max({greatest, std::abs(side_a[k]), std::abs(side_b[k]), std::abs(offset[k]),
                         std::abs(velocity[k])});
  }
  lane.radius_a = a.radius;
  lane.radius = a.radius + b.radius;
  return greatest > 1e-70 && greatest < 1e70 ? LaneLoad::loaded : LaneLoad::refused;
}

void cast_round(std::span<const RoundLane> lanes, std::span<LaneTimes> times) {
  switch (isa()) {
    case Isa::avx512: return avx512::cast_all_lanes(lanes, times);
    case Isa::avx2: return avx2::cast_all_lanes(lanes, times);
    case Isa::baseline: break;
  }
  baseline::cast_all_lanes(lanes, times);
}

}  // namespace touchstone
