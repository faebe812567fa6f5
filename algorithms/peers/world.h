// World bounds for structures that need fixed ones: a box around everything, with room to move.
// Used by the broad phases of Bullet, FCL and ODE.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "algorithms/core/aabb.h"

namespace touchstone {

// A box of positive and finite extent on each axis (metres).
struct World {
  std::array<double, 3> min{-1, -1, -1};
  std::array<double, 3> max{1, 1, 1};

  // Returns a box twice as wide as the boxes together, with no axis thinner than a thousandth of
  // the widest, so that a flat scene has room too. Empty boxes are ignored; without any other the
  // box is two metres wide.
  static World around(std::span<const Aabb> boxes);

  // True if the box is strictly inside.
  bool holds(const Aabb& box) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(box.min[axis] > min[axis] && box.max[axis] < max[axis])) return false;
    }
    return true;
  }
  double widest() const { return std::max({max[0] - min[0], max[1] - min[1], max[2] - min[2]}); }
};

inline World World::around(std::span<const Aabb> boxes) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  World bounds{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (const Aabb& box : boxes) {
    if (box.is_empty()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::min(bounds.min[axis], static_cast<double>(box.min[axis]));
      bounds.max[axis] = std::max(bounds.max[axis], static_cast<double>(box.max[axis]));
    }
  }
  if (bounds.min[0] > bounds.max[0]) return {};
  const double widest = bounds.widest();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double& low = bounds.min[axis];
    double& high = bounds.max[axis];
    // The last two terms keep the room above the rounding of coordinates, and above zero.
    const double room = std::max(
        {(high - low) / 2, widest / 1000, 1e-6 * std::max(std::abs(low), std::abs(high)), 1e-20});
    low -= room;
    high += room;
  }
  return bounds;
}

}  // namespace touchstone
