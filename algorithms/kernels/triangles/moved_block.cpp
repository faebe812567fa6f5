// The choice of the instruction level for blocks that move.
#include "algorithms/kernels/triangles/moved_block.h"

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/triangles/moved_block.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
void move(const TriangleBlockOf<Scalar>& block, const Pose& pose, TriangleBlock& moved) {
  switch (isa()) {
    case Isa::avx512: return avx512::move_block(block, pose, moved);
    case Isa::avx2: return avx2::move_block(block, pose, moved);
    case Isa::baseline: break;
  }
  baseline::move_block(block, pose, moved);
}
template void move(const FloatTriangleBlock&, const Pose&, TriangleBlock&);
template void move(const TriangleBlock&, const Pose&, TriangleBlock&);

}  // namespace touchstone
