// Extents of blocks, and the choice of the instruction level.
#include "algorithms/kernels/triangles/block_extent.h"

#include <tuple>
#include <utility>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

struct BlockEnds {
  std::array<double, TriangleBlock::size> low, high;
};

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/triangles/block_extent.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

template <class Block, class Ways, std::size_t count>
void ends_of(const Block& block, const Ways& ways, std::array<BlockEnds, count>& ends) {
  switch (isa()) {
    case Isa::avx512: return avx512::ends_of_block(block, ways, ends);
    case Isa::avx2: return avx2::ends_of_block(block, ways, ends);
    case Isa::baseline: break;
  }
  baseline::ends_of_block(block, ways, ends);
}

// The ends of all triangles; NaN if one is not finite. Without branches, which nothing foresees.
std::pair<double, double> ends_of_all(const BlockEnds& ends) {
  double low = ends.low[0], high = ends.high[0], sum = 0;
  for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
    low = ends.low[lane] < low ? ends.low[lane] : low;
    high = ends.high[lane] > high ? ends.high[lane] : high;
    sum += ends.low[lane];
  }
  const double nothing = sum - sum;
  return {low + nothing, high + nothing};
}

}  // namespace

template <class Scalar>
BlockExtent extent_along(const TriangleBlockOf<Scalar>& block, const Vec3d& way) {
  std::array<BlockEnds, 1> ends;
  ends_of(block, way.transpose(), ends);
  const auto [low, high] = ends_of_all(ends[0]);
  return {way, low, high};
}

template <class Scalar>
BlockExtent extent_along_normal(const TriangleBlockOf<Scalar>& block) {
  Vec3d sum = Vec3d::Zero();
  for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
    const Vec3d corner = block.corner(lane, 0);
    sum += (block.corner(lane, 1) - corner).cross(block.corner(lane, 2) - corner);
  }
  return extent_along(block, sum.stableNormalized());
}

template <class Scalar>
BlockBox box_along(const TriangleBlockOf<Scalar>& block, const Mat3d& ways) {
  std::array<BlockEnds, 3> ends;
  ends_of(block, ways, ends);
  BlockBox box;
  for (std::size_t row = 0; row < 3; ++row) {
    std::tie(box.low[row], box.high[row]) = ends_of_all(ends[row]);
  }
  return box;
}

template <class Scalar>
unsigned reaching(const TriangleBlockOf<Scalar>& block, const BlockExtent& extent, double slack) {
  switch (isa()) {
    case Isa::avx512: return avx512::reaching_lanes(block, extent, slack);
    case Isa::avx2: return avx2::reaching_lanes(block, extent, slack);
    case Isa::baseline: break;
  }
  return baseline::reaching_lanes(block, extent, slack);
}

template BlockExtent extent_along(const FloatTriangleBlock&, const Vec3d&);
template BlockExtent extent_along_normal(const FloatTriangleBlock&);
template BlockBox box_along(const FloatTriangleBlock&, const Mat3d&);
template unsigned reaching(const FloatTriangleBlock&, const BlockExtent&, double);
template BlockExtent extent_along(const TriangleBlock&, const Vec3d&);
template BlockExtent extent_along_normal(const TriangleBlock&);
template BlockBox box_along(const TriangleBlock&, const Mat3d&);
template unsigned reaching(const TriangleBlock&, const BlockExtent&, double);

}  // namespace touchstone
