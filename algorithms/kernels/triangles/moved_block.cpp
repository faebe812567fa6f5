// The choice of the instruction level for blocks that move or widen.
#include "algorithms/kernels/triangles/moved_block.h"

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/triangles/moved_block.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

template <class Block>
void move_any(const Block& block, const Pose& pose, TriangleBlock& moved) {
  switch (isa()) {
    case Isa::avx512: return avx512::move_block(block, pose, moved);
    case Isa::avx2: return avx2::move_block(block, pose, moved);
    case Isa::baseline: break;
  }
  baseline::move_block(block, pose, moved);
}

}  // namespace

void move(const TriangleBlock& block, const Pose& pose, TriangleBlock& moved) {
  move_any(block, pose, moved);
}
void move(const FloatTriangleBlock& block, const Pose& pose, TriangleBlock& moved) {
  move_any(block, pose, moved);
}

void widen(const FloatTriangleBlock& block, TriangleBlock& wide) {
  switch (isa()) {
    case Isa::avx512: return avx512::widen_block(block, wide);
    case Isa::avx2: return avx2::widen_block(block, wide);
    case Isa::baseline: break;
  }
  baseline::widen_block(block, wide);
}

}  // namespace touchstone
