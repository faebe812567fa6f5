// Extents of blocks, and the choice of the instruction level.
#include "algorithms/kernels/triangles/block_extent.h"

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

struct BlockEnds {
  std::array<double, TriangleBlock::size> low, high;
};

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/triangles/block_extent.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

void ends_of(const TriangleBlock& block, const Vec3d& way, BlockEnds& ends) {
  switch (isa()) {
    case Isa::avx512: return avx512::ends_of_block(block, way, ends);
    case Isa::avx2: return avx2::ends_of_block(block, way, ends);
    case Isa::baseline: break;
  }
  baseline::ends_of_block(block, way, ends);
}

void ends_along(const TriangleBlock& block, const Mat3d& ways, std::array<BlockEnds, 3>& ends) {
  switch (isa()) {
    case Isa::avx512: return avx512::ends_along_rows(block, ways, ends);
    case Isa::avx2: return avx2::ends_along_rows(block, ways, ends);
    case Isa::baseline: break;
  }
  baseline::ends_along_rows(block, ways, ends);
}

}  // namespace

BlockExtent extent_along(const TriangleBlock& block, const Vec3d& way) {
  BlockEnds ends;
  ends_of(block, way, ends);
  BlockExtent extent = {way, ends.low[0], ends.high[0]};
  for (std::size_t lane = 1; lane < TriangleBlock::size; ++lane) {
    // NaN stays.
    if (!(ends.low[lane] >= extent.low) && extent.low == extent.low) extent.low = ends.low[lane];
    if (!(ends.high[lane] <= extent.high) && extent.high == extent.high) {
      extent.high = ends.high[lane];
    }
  }
  return extent;
}

BlockExtent extent_along_normal(const TriangleBlock& block) {
  Vec3d sum = Vec3d::Zero();
  for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
    const Vec3d corner = block.corner(lane, 0);
    sum += (block.corner(lane, 1) - corner).cross(block.corner(lane, 2) - corner);
  }
  return extent_along(block, sum.stableNormalized());
}

BlockBox box_along(const TriangleBlock& block, const Mat3d& ways) {
  std::array<BlockEnds, 3> ends;
  ends_along(block, ways, ends);
  BlockBox box;
  double sum = 0;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto &low = ends[row].low, &high = ends[row].high;
    double least = low[0], greatest = high[0];
    for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
      least = low[lane] < least ? low[lane] : least;
      greatest = high[lane] > greatest ? high[lane] : greatest;
      sum += low[lane];
    }
    box.low[row] = least;
    box.high[row] = greatest;
  }
  const double nothing = sum - sum;  // NaN if anything is not finite
  for (std::size_t row = 0; row < 3; ++row) {
    box.low[row] += nothing;
    box.high[row] += nothing;
  }
  return box;
}

unsigned reaching(const TriangleBlock& block, const BlockExtent& extent, double slack) {
  switch (isa()) {
    case Isa::avx512: return avx512::reaching_lanes(block, extent, slack);
    case Isa::avx2: return avx2::reaching_lanes(block, extent, slack);
    case Isa::baseline: break;
  }
  return baseline::reaching_lanes(block, extent, slack);
}

}  // namespace touchstone
