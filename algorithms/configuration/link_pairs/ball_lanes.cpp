// Part of link-pairs: the choice of the instruction level.
#include "algorithms/configuration/link_pairs/ball_lanes.h"

#include "algorithms/core/isa.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/configuration/link_pairs/ball_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

std::uint32_t scan_rows(std::span<const LaneRow> rows, std::span<const LaneBall> balls,
                        std::span<const LaneBox> boxes, std::uint32_t alive,
                        std::vector<LaneHit>& hits) {
  switch (isa()) {
    case Isa::avx512: return avx512::scan(rows, balls, boxes, alive, hits);
    case Isa::avx2: return avx2::scan(rows, balls, boxes, alive, hits);
    case Isa::baseline: break;
  }
  return baseline::scan(rows, balls, boxes, alive, hits);
}

}  // namespace touchstone
