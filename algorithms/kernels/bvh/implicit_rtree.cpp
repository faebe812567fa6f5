// The levels of the implicit R-tree, and the choice of the instruction level for its searches.
#include "algorithms/kernels/bvh/implicit_rtree.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/kernels/boxes/aabb_simd.h"
#include "algorithms/kernels/boxes/structure_boxes.h"

namespace touchstone {
namespace {

using aabb_simd::Columns;
using aabb_simd::columns_of;
using aabb_simd::first_lanes;
using aabb_simd::MutableColumns;

constexpr std::size_t fan = ImplicitRTree::fan;

// Returns the number of the parents' children at or after `from`; their level has `size` nodes.
std::size_t children_of(std::span<const std::uint32_t> parents, std::size_t size,
                        std::size_t from) {
  std::size_t children = 0;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const std::size_t first = parents[i] * fan;
    children += std::min(first + fan, size) - std::max(first, from);
  }
  return children;
}

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/bvh/implicit_rtree.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

// Computes the bounds of the 16 boxes below each of these nodes; `below` is padded with empty boxes.
void bound(const AabbSoA& below, AabbSoA& above, std::size_t first, std::size_t last) {
  switch (isa()) {
    case Isa::avx512: return avx512::bound(below, above, first, last);
    case Isa::avx2: return avx2::bound(below, above, first, last);
    case Isa::baseline: return baseline::bound(below, above, first, last);
  }
}

}  // namespace

void ImplicitRTree::resize(std::size_t count) {
  levels_[0].resize(count);
  // The levels of blocks and groups always exist.
  for (used_ = 1; used_ < 3 || levels_[used_ - 1].size() > 1; ++used_) {
    if (levels_.size() == used_) levels_.emplace_back();
    levels_[used_].resize(block_count(levels_[used_ - 1].size(), fan));
  }
}

void ImplicitRTree::bound_groups(std::size_t first, std::size_t last) {
  bound(levels_[0], levels_[1], first / fan, block_count(last, fan));
  bound(levels_[1], levels_[2], first / group, block_count(last, group));
}

void ImplicitRTree::bound_above(Executor& executor) {
  constexpr std::size_t nodes_a_task = 256;
  for (std::size_t level = 3; level < used_; ++level) {
    for_each_block(executor, levels_[level].size(), nodes_a_task,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     bound(levels_[level - 1], levels_[level], first, last);
                   });
  }
}

double ImplicitRTree::spread() const {
  if (used_ < 2) return 0;
  const AabbSoA& blocks = levels_[1];
  std::array<double, 8> sums{};  // eight sums side by side, since one would wait for each addition
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

std::vector<StructureBox> ImplicitRTree::structure() const {
  std::vector<StructureBox> nodes;
  for (std::uint32_t depth = 0; depth + 1 < used_; ++depth) {
    for (const Aabb& box : list_boxes(levels_[used_ - 1 - depth])) {
      if (!box.is_empty()) nodes.push_back({box, depth});
    }
  }
  return nodes;
}

std::size_t ImplicitRTree::held_bytes() const {
  std::size_t bytes = 0;
  for (const AabbSoA& level : levels_) bytes += level.held_bytes();
  return bytes;
}

void pair_group(const ImplicitRTree& tree, std::size_t group, RTreeScratch& scratch,
                PairBuffer& out) {
  switch (isa()) {
    case Isa::avx512: return avx512::search(tree, group, scratch, out);
    case Isa::avx2: return avx2::search(tree, group, scratch, out);
    case Isa::baseline: return baseline::search(tree, group, scratch, out);
  }
}

std::size_t list_overlaps(const ImplicitRTree& tree, const Aabb& box, RTreeScratch& scratch) {
  switch (isa()) {
    case Isa::avx512: return avx512::list(tree, box, scratch);
    case Isa::avx2: return avx2::list(tree, box, scratch);
    default: return baseline::list(tree, box, scratch);
  }
}

// A pair of two of the bodies counts at the smaller id.
void search_bodies(Executor& executor, const ImplicitRTree& tree, std::span<const Aabb> boxes,
                   std::span<const std::uint32_t> bodies, const BodyMarks& asked,
                   std::vector<RTreeScratch>& scratch, PairSink& sink) {
  constexpr std::size_t bodies_a_task = 64;
  sink.start(block_count(bodies.size(), bodies_a_task));
  const auto search = [&](std::size_t task, int worker) {
    RTreeScratch& own = scratch[static_cast<std::size_t>(worker)];
    const std::size_t last = std::min((task + 1) * bodies_a_task, bodies.size());
    for (std::size_t i = task * bodies_a_task; i < last; ++i) {
      const std::uint32_t a = bodies[i];
      if (boxes[a].is_empty()) continue;
      const std::size_t found = list_overlaps(tree, boxes[a], own);
      for (const std::uint32_t b : std::span(own.children).first(found)) {
        if (a < b || (a > b && !asked.has(b))) sink.chunk(task).push(a, b);
      }
    }
  };
  executor.run(sink.chunks().size(), std::cref(search));
}

}  // namespace touchstone
