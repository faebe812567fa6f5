// How many boxes there are of each magnitude, and how long they are: what size classes are made of.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"

namespace touchstone {

struct BoxMeasure {
  std::size_t members = 0;
  std::array<double, 3> side{};  // the longest on each axis

  void add(const BoxMeasure& other) {
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

// By the power of two of the longest side: as many as a float can have.
inline constexpr std::size_t box_magnitudes = 256;
inline std::size_t magnitude(const Aabb& box) {
  const float side =
      std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  return std::bit_cast<std::uint32_t>(side) >> 23 & (box_magnitudes - 1);
}
using BoxMeasures = std::array<BoxMeasure, box_magnitudes>;

// `ids`: of boxes that are not empty. `blocks`: scratch memory.
BoxMeasures measure_boxes(Executor& executor, std::span<const Aabb> boxes,
                          std::span<const std::uint32_t> ids, std::vector<BoxMeasures>& blocks);

}  // namespace touchstone
