#include "algorithms/kernels/bvh/implicit_rtree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "algorithms/core/parallel_blocks.h"
#include "algorithms/kernels/boxes/aabb_lanes.h"

namespace touchstone {
namespace {

using box_lanes::Columns;
using box_lanes::columns_of;

constexpr std::size_t fan = ImplicitRTree::fan;

Columns columns_of(const ListedBoxes& list) {
  return {{list.extent(0), list.extent(1), list.extent(2)},
          {list.extent(3), list.extent(4), list.extent(5)},
          list.ids()};
}

// How many nodes of a level of this size, not before `from`, the parents have.
std::size_t children_of(const std::vector<std::uint32_t>& parents, std::size_t count,
                        std::size_t size, std::size_t from) {
  std::size_t children = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = parents[i] * fan;
    children += std::min(first + fan, size) - std::max(first, from);
  }
  return children;
}

#define TOUCHSTONE_LOOPS "algorithms/kernels/bvh/implicit_rtree.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

// The bounds of each 16 of `below`, which is padded with empty boxes.
void bound(Executor& executor, const AabbSoA& below, AabbSoA& above) {
  const std::size_t count = block_count(below.size(), fan);
  above.resize(count);
  for_each_block(executor, count, 256, [&](std::size_t, std::size_t first, std::size_t last) {
    switch (isa()) {
      case Isa::avx512: return avx512::bound(below, above, first, last);
      case Isa::avx2: return avx2::bound(below, above, first, last);
      case Isa::baseline: return baseline::bound(below, above, first, last);
    }
  });
}

}  // namespace

void ImplicitRTree::fit(Executor& executor) {
  // Blocks and groups there are always.
  for (used_ = 1; used_ < 3 || levels_[used_ - 1].size() > 1; ++used_) {
    if (levels_.size() == used_) levels_.emplace_back();
    bound(executor, levels_[used_ - 1], levels_[used_]);
  }
}

double ImplicitRTree::spread() const {
  if (used_ < 2) return 0;
  const AabbSoA& blocks = levels_[1];
  std::array<double, 8> sums{};  // side by side: one alone would be waited for at each step
  for (int axis = 0; axis < 3; ++axis) {
    const float* const min = blocks.min(axis);
    const float* const max = blocks.max(axis);
    const std::size_t whole = blocks.size() / sums.size() * sums.size();
    for (std::size_t i = 0; i < whole; i += sums.size()) {
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += double{max[i + k]} - min[i + k];
    }
    for (std::size_t i = whole; i < blocks.size(); ++i) sums[0] += double{max[i]} - min[i];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

std::size_t ImplicitRTree::held_bytes() const {
  std::size_t bytes = 0;
  for (const AabbSoA& level : levels_) bytes += level.held_bytes();
  return bytes;
}

void ListedBoxes::grow(std::size_t more) {
  const std::size_t capacity = std::max(size_ + more + AabbSoA::padding, 2 * capacity_);
  auto extents = std::make_unique_for_overwrite<float[]>(6 * capacity);
  auto ids = std::make_unique_for_overwrite<std::uint32_t[]>(capacity);
  for (std::size_t i = 0; i < 6; ++i) {
    std::copy_n(extents_.get() + i * capacity_, size_, extents.get() + i * capacity);
  }
  std::copy_n(ids_.get(), size_, ids.get());
  extents_ = std::move(extents);
  ids_ = std::move(ids);
  capacity_ = capacity;
}

void pair_group(const ImplicitRTree& pyramid, std::size_t group, RTreeScratch& scratch,
                PairBuffer& out) {
  switch (isa()) {
    case Isa::avx512: return avx512::search(pyramid, group, scratch, out);
    case Isa::avx2: return avx2::search(pyramid, group, scratch, out);
    case Isa::baseline: return baseline::search(pyramid, group, scratch, out);
  }
}

std::size_t list_overlaps(const ImplicitRTree& pyramid, const Aabb& box, RTreeScratch& scratch) {
  switch (isa()) {
    case Isa::avx512: return avx512::list(pyramid, box, scratch);
    case Isa::avx2: return avx2::list(pyramid, box, scratch);
    default: return baseline::list(pyramid, box, scratch);
  }
}

}  // namespace touchstone
