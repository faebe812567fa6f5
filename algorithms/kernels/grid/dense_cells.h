// Dense cells: long runs of items with equal keys, where a grid cannot tell bodies apart. Used by
// the uniform and the hierarchical grid.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/grid/cell_space.h"
#include "algorithms/kernels/sorting/ordered_key.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

// Calls visit(run) for each maximal run of at least `least` >= 2 places in the range whose keys are
// equal. It probes every `least` / 2 places and skips most of the others.
template <class Key, class Visit>
void visit_dense_cells(IndexRange range, std::size_t least, const Key& key, const Visit& visit) {
  const std::size_t step = least / 2;  // a run this long contains both ends of some step
  for (std::size_t i = range.first; i + step < range.last; i += step) {
    if (key(i) != key(i + step)) continue;
    IndexRange run{i, i + step};
    while (run.first > range.first && key(run.first - 1) == key(i)) --run.first;
    while (run.last < range.last && key(run.last) == key(i)) ++run.last;
    i += (run.last - 1 - i) / step * step;
    if (run.last - run.first >= least) visit(run);
  }
}

// Returns the axis with the greatest spread of minima relative to the boxes' mean length. `box(i)`
// is defined for i < count.
template <class Box>
std::size_t longest_axis(std::size_t count, const Box& box) {
  std::array<double, 3> low, high, side{};
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; ++i) {
    const Aabb& own = box(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], double{own.min[axis]});
      high[axis] = std::max(high[axis], double{own.min[axis]});
      side[axis] += double{own.max[axis]} - own.min[axis];
    }
  }
  side = with_floor(side);
  std::array<double, 3> extent;
  for (std::size_t axis = 0; axis < 3; ++axis) extent[axis] = (high[axis] - low[axis]) / side[axis];
  return static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
}

// Sorts a dense cell by its boxes' minima on the axis that separates them best. It keeps its memory
// between calls.
template <class Item>
class DenseCellSort {
 public:
  // Returns the axis. `id(item)` is the index of the item's box.
  template <class Id>
  int operator()(Executor& executor, std::span<const Aabb> boxes, std::span<Item> dense_cell,
                 const Id& id) {
    before_.assign(dense_cell.begin(), dense_cell.end());
    const auto box = [&](std::size_t i) { return boxes[id(before_[i])]; };
    const std::size_t axis = longest_axis(dense_cell.size(), box);
    order_.resize(dense_cell.size());
    for (std::uint32_t i = 0; i < dense_cell.size(); ++i) {
      order_[i] = sort_item(ordered_key(box(i).min[axis]), i);
    }
    radix_sort_(executor, order_, 32, key_of);
    for (std::size_t i = 0; i < dense_cell.size(); ++i)
      dense_cell[i] = before_[index_of(order_[i])];
    return static_cast<int>(axis);
  }

  std::size_t held_bytes() const {
    return before_.capacity() * sizeof(Item) + order_.capacity() * sizeof(std::uint64_t) +
           radix_sort_.held_bytes();
  }

 private:
  std::vector<Item> before_;
  std::vector<std::uint64_t> order_;
  RadixSort<std::uint64_t> radix_sort_;
};

}  // namespace touchstone
