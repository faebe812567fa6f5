// Crowds: many items one behind the other with the same key, as bodies have that a grid cannot tell
// apart.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "algorithms/core/aabb.h"
#include "algorithms/kernels/box_arrays.h"

namespace touchstone {

// Calls visit(run) for each longest run of at least `least` >= 2 places of the range whose keys are
// equal. Looks at few of the others.
template <class Key, class Visit>
void visit_crowds(IndexRange range, std::size_t least, const Key& key, const Visit& visit) {
  const std::size_t step = least / 2;  // such a run holds both ends of one of the steps
  for (std::size_t i = range.first; i + step < range.last; i += step) {
    if (key(i) != key(i + step)) continue;
    IndexRange run{i, i + step};
    while (run.first > range.first && key(run.first - 1) == key(i)) --run.first;
    while (run.last < range.last && key(run.last) == key(i)) ++run.last;
    i += (run.last - 1 - i) / step * step;
    if (run.last - run.first >= least) visit(run);
  }
}

// The axis on which these boxes lie farthest apart for their mean length. `box(i)`, i < count.
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
  // Flat boxes are not to be told apart by a hair on the axis on which they are flat.
  const double least = 1e-3 * std::ranges::max(side);
  std::array<double, 3> extent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent[axis] = (high[axis] - low[axis]) / (least > 0 ? std::max(side[axis], least) : 1);
  }
  return static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
}

}  // namespace touchstone
