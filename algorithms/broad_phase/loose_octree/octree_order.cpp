// Part of loose-octree: computes the keys (Morton code and depth of a box's cell) and sorts the
// boxes by them.
#include "algorithms/broad_phase/loose_octree/octree_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"

namespace touchstone {
namespace {

constexpr std::size_t bodies_per_block = 4096;

// Each cell number with two zeros between its bits. A Morton code interleaves three of them
// (Morton, "A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing", 1966).
constexpr std::array<std::uint32_t, 1 << OctreeOrder::most_levels> spread = [] {
  std::array<std::uint32_t, 1 << OctreeOrder::most_levels> all{};
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    for (int bit = 0; bit < OctreeOrder::most_levels; ++bit) all[i] |= (i >> bit & 1) << 3 * bit;
  }
  return all;
}();

// Returns the least n >= 0 with 2^n >= x.
int ceil_log2(double x) {
  if (!(x > 1)) return 0;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const bool is_power = (bits & ((std::uint64_t{1} << 52) - 1)) == 0;
  return static_cast<int>(bits >> 52) - 1023 + (is_power ? 0 : 1);
}

double centre(const Aabb& box, std::size_t axis) {
  return 0.5 * (double{box.min[axis]} + box.max[axis]);
}

}  // namespace

int OctreeOrder::common_levels(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t differs = (a ^ b) >> depth_bits;
  return most_levels - (static_cast<int>(std::bit_width(differs)) + 2) / 3;
}

// Cells have the proportions of the usual box; the root contains the whole region.
OctreeOrder::Cells OctreeOrder::make_cells(const BoxSample& sample, double bodies) {
  const double root = sample.extent();
  Cells cells{.space = {.origin = sample.low}, .levels = 1};
  const auto used = [&](int levels) {
    double count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = (sample.high[axis] - sample.low[axis]) / sample.side[axis];
      count *= root > 0 ? std::max(1.0, std::ldexp(extent / root, levels)) : 1;
    }
    return count;
  };
  while (cells.levels < most_levels && used(cells.levels) < bodies) ++cells.levels;
  cells.space.last.fill((1u << cells.levels) - 1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // An octree without extent has one cell.
    const double length = root * sample.side[axis];
    cells.space.inverse_side[axis] = length > 0 ? std::ldexp(1 / length, cells.levels) : 0;
  }
  return cells;
}

std::uint32_t OctreeOrder::key_of(const Aabb& box, const Cells& cells, bool by_size) {
  std::uint32_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    code |= spread[cells.space.cell(centre(box, axis), axis)] << axis;
  }
  code <<= 3 * (most_levels - cells.levels);
  const int above = by_size ? std::min(ceil_log2(cells.space.size(box)), cells.levels) : 0;
  const int depth = above == 0 ? most_levels : cells.levels - above;
  const int below = 3 * (most_levels - depth);
  return (code >> below << below) << depth_bits | static_cast<std::uint32_t>(depth);
}

void OctreeOrder::sort(Executor& executor, std::span<const Aabb> boxes,
                       std::span<const std::uint32_t> ids) {
  items_.resize(ids.size());
  if (ids.empty()) return;
  id_bits_ = static_cast<int>(std::bit_width(boxes.size()));
  const BoxSample sample = sample_boxes(boxes, ids);
  const double wanted = 2 * static_cast<double>(ids.size()) * clustering_of(boxes, ids, sample);
  const Cells cells = make_cells(sample, wanted);
  for_each_block(executor, ids.size(), bodies_per_block,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const std::uint64_t key = key_of(boxes[ids[i]], cells, true);
                     items_[i] = key << id_bits_ | ids[i];
                   }
                 });
  sort_items(executor, items_, cells.levels, radix_sort_);
}

// Sorts by key, without the digits of unused levels.
void OctreeOrder::sort_items(Executor& executor, std::vector<std::uint64_t>& items, int levels,
                             RadixSort<std::uint64_t>& radix_sort) const {
  const std::uint64_t depth = (1u << depth_bits) - 1;
  const int code_shift = id_bits_ + depth_bits + 3 * (most_levels - levels);
  radix_sort(executor, items, 3 * levels + depth_bits, [=, shift = id_bits_](std::uint64_t item) {
    return item >> code_shift << depth_bits | (item >> shift & depth);
  });
}

bool OctreeOrder::refine(Executor& executor, std::span<const Aabb> boxes, std::size_t first,
                         std::size_t last) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  BoxSample all{.low = {inf, inf, inf}, .high = {-inf, -inf, -inf}, .side = {}};
  for (std::size_t i = first; i < last; ++i) {
    const Aabb& box = boxes[id(i)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], centre(box, axis));
      all.high[axis] = std::max(all.high[axis], centre(box, axis));
      all.side[axis] += double{box.max[axis]} - box.min[axis];
    }
  }
  if (all.low == all.high) return false;
  all.side = with_floor(all.side);
  const Cells cells = make_cells(all, 2 * static_cast<double>(last - first));
  const bool by_size = depth(key(first)) == most_levels;
  dense_cell_.clear();
  for (std::size_t i = first; i < last; ++i) {
    const std::uint64_t key = key_of(boxes[id(i)], cells, by_size);
    dense_cell_.push_back(key << id_bits_ | id(i));
  }
  if (dense_cell_.size() < 1024) {
    std::ranges::sort(dense_cell_);
  } else {
    sort_items(executor, dense_cell_, cells.levels, dense_sort_);
  }
  std::ranges::copy(dense_cell_, items_.begin() + static_cast<std::ptrdiff_t>(first));
  return true;
}

std::size_t OctreeOrder::held_bytes() const {
  return touchstone::held_bytes(items_) + touchstone::held_bytes(radix_sort_) +
         touchstone::held_bytes(dense_cell_) + touchstone::held_bytes(dense_sort_);
}

}  // namespace touchstone
