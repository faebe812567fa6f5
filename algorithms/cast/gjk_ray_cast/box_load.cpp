// Part of gjk-ray-cast-lanes: selects the level of vector instructions at which pairs of boxes are loaded.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "algorithms/cast/gjk_ray_cast/box_lanes.h"

// Four numbers fill no wider vectors.
#if !defined(TOUCHSTONE_TWO_LEVELS)
#define TOUCHSTONE_TWO_LEVELS
#define TOUCHSTONE_BOX_LOAD_HAS_TWO_LEVELS
#endif
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using simd::Quad;

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/cast/gjk_ray_cast/box_load.inl"
#include "algorithms/kernels/simd/foreach_target.inl"
#if defined(TOUCHSTONE_BOX_LOAD_HAS_TWO_LEVELS)
#undef TOUCHSTONE_TWO_LEVELS
#undef TOUCHSTONE_BOX_LOAD_HAS_TWO_LEVELS
#endif

}  // namespace

LaneLoad load_box_lane(const Shape& a, const Pose& pose_a, const Motion& motion_a, const Shape& b,
                       const Pose& pose_b, const Motion& motion_b, BoxLane& lane) {
  const auto ask = isa() == Isa::baseline ? baseline::ask_boxes : avx2::ask_boxes;
  return ask(a, pose_a, motion_a, b, pose_b, motion_b, lane);
}

}  // namespace touchstone
