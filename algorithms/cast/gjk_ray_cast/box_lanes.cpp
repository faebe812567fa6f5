// Part of gjk-ray-cast-lanes: selects the level of vector instructions.
#include "algorithms/cast/gjk_ray_cast/box_lanes.h"

#include <algorithm>
#include <concepts>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/cast/gjk_ray_cast/box_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

void cast_boxes(std::span<const BoxLane> lanes, std::span<LaneTimes> times) {
  switch (isa()) {
    case Isa::avx512: return avx512::cast_all_lanes(lanes, times);
    case Isa::avx2: return avx2::cast_all_lanes(lanes, times);
    case Isa::baseline: break;
  }
  baseline::cast_all_lanes(lanes, times);
}

}  // namespace touchstone
