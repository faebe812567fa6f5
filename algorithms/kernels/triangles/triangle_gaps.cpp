// Gaps of triangles in lanes, and the choice of the instruction level.
//
// The square of a gap of boxes is off by less than 8 u of itself, a gap along the way by less than 8 u
// of itself and of the ends, u half an epsilon. The limits are raised by 2^-40 of themselves for what is of
// the gaps; the caller's limit has room for what is of the ends. Squares that underflow are off by
// less than the least normal double.
#include "algorithms/kernels/triangles/triangle_gaps.h"

#include <limits>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/triangles/triangle_gaps.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

NearTriangles near_triangles(const TriangleBlock& a, unsigned count_a, const TriangleBlock& b,
                             unsigned count_b, const Vec3d& way, double limit) {
  switch (isa()) {
    case Isa::avx512: return avx512::near_lanes(a, count_a, b, count_b, way, limit);
    case Isa::avx2: return avx2::near_lanes(a, count_a, b, count_b, way, limit);
    case Isa::baseline: break;
  }
  return baseline::near_lanes(a, count_a, b, count_b, way, limit);
}

void gaps_of_pairs(const TriangleBlock& a, const TriangleBlock& b,
                   std::array<double, TriangleBlock::size>& gap) {
  switch (isa()) {
    case Isa::avx512: return avx512::gap_lanes(a, b, gap);
    case Isa::avx2: return avx2::gap_lanes(a, b, gap);
    case Isa::baseline: break;
  }
  baseline::gap_lanes(a, b, gap);
}

}  // namespace touchstone
