// Part of link-pairs: the choice of the instruction level.
#include "algorithms/configuration/link_pairs/ball_lanes.h"

#include <algorithm>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/configuration/link_pairs/ball_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

PoseReach spread_poses(const Pose* poses, std::size_t stride, std::size_t count, LanePose& lanes) {
  switch (isa()) {
    case Isa::avx512: return avx512::spread(poses, stride, count, lanes);
    case Isa::avx2: return avx2::spread(poses, stride, count, lanes);
    case Isa::baseline: break;
  }
  return baseline::spread(poses, stride, count, lanes);
}

void place_balls(const LanePose& link, std::span<const std::array<float, 3>> centres,
                 std::span<LaneBall> balls) {
  switch (isa()) {
    case Isa::avx512: return avx512::place(link, centres, balls);
    case Isa::avx2: return avx2::place(link, centres, balls);
    case Isa::baseline: break;
  }
  baseline::place(link, centres, balls);
}

std::uint32_t scan_rows(std::span<const LaneRow> rows, std::uint32_t first, std::uint32_t last,
                        std::span<const LaneBall> balls, std::span<const LaneBox> boxes,
                        float slack, std::uint32_t lanes, std::vector<LaneHit>& hits,
                        std::vector<LaneHit>& sure) {
  switch (isa()) {
    case Isa::avx512:
      return avx512::scan(rows, first, last, balls, boxes, slack, lanes, hits, sure);
    case Isa::avx2: return avx2::scan(rows, first, last, balls, boxes, slack, lanes, hits, sure);
    case Isa::baseline: break;
  }
  return baseline::scan(rows, first, last, balls, boxes, slack, lanes, hits, sure);
}

}  // namespace touchstone
