// Part of hierarchical-grid: the number of boxes of each magnitude and their longest sides, from
// which the size classes are chosen.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"

namespace touchstone {

struct MagnitudeBin {
  std::size_t members = 0;
  std::array<double, 3> side{};  // longest side on each axis, metres

  void add(const MagnitudeBin& other) {
    members += other.members;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side[axis] = std::max(side[axis], other.side[axis]);
    }
  }
  void add(const Aabb& box) {
    ++members;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side[axis] = std::max(side[axis], double{box.max[axis]} - box.min[axis]);
    }
  }
};

// A box's magnitude is the exponent of its longest side; a float has this many exponents.
inline constexpr std::size_t box_magnitudes = 256;
inline std::size_t magnitude(const Aabb& box) {
  const float side =
      std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  return std::bit_cast<std::uint32_t>(side) >> 23 & (box_magnitudes - 1);
}
using MagnitudeHistogram = std::array<MagnitudeBin, box_magnitudes>;

// `ids` lists the boxes that are not empty; `blocks` is scratch memory.
MagnitudeHistogram magnitude_histogram(Executor& executor, std::span<const Aabb> boxes,
                                       std::span<const std::uint32_t> ids,
                                       std::vector<MagnitudeHistogram>& blocks);

}  // namespace touchstone
