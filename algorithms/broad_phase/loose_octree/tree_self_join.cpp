// Part of loose-octree: the choice of the instruction level for the loops of tree_self_join.inl.
#include "algorithms/broad_phase/loose_octree/tree_self_join.h"

#include <algorithm>
#include <limits>

#include "algorithms/kernels/boxes/aabb_simd.h"

namespace touchstone {
namespace {

using aabb_simd::Columns;
using aabb_simd::columns_of;
using aabb_simd::first_lanes;
using aabb_simd::mutable_columns_of;

constexpr std::size_t fan = NodeRef::fan;

struct Join {
  const JoinTree& tree;
  Columns nodes, boxes;
  JoinScratch& scratch;
  PairBuffer& out;
};

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/broad_phase/loose_octree/tree_self_join.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

void join_block(const JoinTree& tree, const AabbSoA& boxes, std::size_t block, JoinPart part,
                JoinScratch& scratch, PairBuffer& out) {
  const Join join{tree, columns_of(tree.nodes), columns_of(boxes), scratch, out};
  switch (isa()) {
    case Isa::avx512: return avx512::join_from_root(join, block, part);
    case Isa::avx2: return avx2::join_from_root(join, block, part);
    case Isa::baseline: return baseline::join_from_root(join, block, part);
  }
}

}  // namespace touchstone
