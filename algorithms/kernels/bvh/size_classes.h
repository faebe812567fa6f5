// Size classes: boxes of about one size share a class, so that small boxes that are bounded together
// have small bounds. Used by Hilbert sort.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "algorithms/core/aabb.h"

namespace touchstone {

// The bounds of the doubled centres (min + max) of some boxes.
struct CentreRegion {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{inf, inf, inf}, high{-inf, -inf, -inf};

  void add(const Aabb& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float centre = box.min[axis] + box.max[axis];
      low[axis] = std::min(low[axis], centre);
      high[axis] = std::max(high[axis], centre);
    }
  }
};

// Estimates for all boxes from every stride-th one.
struct SizeSample {
  // The magnitude of a box is that of its longest side; there are two to an octave.
  static constexpr std::size_t magnitudes = 512;

  SizeSample(std::span<const Aabb> boxes, std::size_t every);
  bool empty() const { return region.low[0] > region.high[0]; }

  CentreRegion region;
  std::array<std::uint32_t, magnitudes> members{};  // number of boxes of each magnitude
  std::size_t stride;
};

// Takes a sample of about a thousand boxes; if none of these has a body, one of all boxes.
SizeSample take_sample(std::span<const Aabb> boxes);

class SizeClasses {
 public:
  static constexpr std::size_t most = 16;

  // Makes classes from the smallest size up. Boxes that are not much larger than the space of 16
  // boxes can share a class with the smallest; the larger ones are fewer, so 16 of them have more
  // space, and the same rule makes the next class.
  explicit SizeClasses(const SizeSample& sample);

  std::size_t count() const { return count_; }
  // Writes the class of each box, the smaller boxes' first; count() for an empty box.
  void of(std::span<const Aabb> boxes, std::uint32_t* classes) const;

 private:
  void add_class(std::size_t end);

  std::size_t count_ = 0;
  std::size_t end_ = 0;  // first magnitude without a class
  // The least bits of a longest side in each class but the first, and those of no side.
  std::array<std::int32_t, most> begins_{};
};

}  // namespace touchstone
