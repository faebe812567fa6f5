// Measures of single boxes. Used by several broad phases.
#pragma once

#include <cstddef>

#include "algorithms/core/aabb.h"

namespace touchstone {

// True when `outer` contains `inner`; any box contains an empty one. It has no branch, since the
// outcome is hard to predict.
constexpr bool contains(const Aabb& outer, const Aabb& inner) {
  bool held = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    held &= (outer.min[axis] <= inner.min[axis]) & (inner.max[axis] <= outer.max[axis]);
  }
  return held;
}

// Returns the sum of a box's sides, metres.
constexpr double sum_of_sides(const Aabb& box) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += double{box.max[axis]} - box.min[axis];
  return sum;
}

}  // namespace touchstone
