// Places along a Hilbert curve: neighbours on the curve are neighbours in space.
// Paper: Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/core/aabb.h"

namespace touchstone {

// A grid of equally many cells on each axis over a region; a box belongs to the cell of its centre.
// Axes on which the region is flat have one cell, and their bits go to the others.
class HilbertGrid {
 public:
  // Of doubled centres (min + max of a box), low <= high, finite. At most `code_bits` bits a place,
  // 3 <= code_bits <= 30.
  HilbertGrid(const std::array<float, 3>& low, const std::array<float, 3>& high, int code_bits);

  int code_bits() const { return axes_ * bits_; }
  // Of the boxes' centres: codes[i] is that of boxes[i]. The same at every level of vector
  // instructions. Empty boxes have some code.
  void codes(std::span<const Aabb> boxes, std::uint32_t* codes) const;
  // codes[i] is that of boxes[ids[i]].
  void codes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
             std::uint32_t* codes) const;

 private:
  // Of box_of(i), i < total.
  template <class Box>
  void codes_of(std::size_t total, const Box& box_of, std::uint32_t* codes) const;

  std::array<float, 3> low_, scale_;
  std::array<std::size_t, 3> axis_;  // those that count come first
  int axes_ = 0;
  int bits_ = 0;  // an axis
};

}  // namespace touchstone
