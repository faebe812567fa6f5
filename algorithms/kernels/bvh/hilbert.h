// Places along a Hilbert curve: neighbours on the curve are neighbours in space. Used by Hilbert
// sort.
// Paper: Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/core/aabb.h"

namespace touchstone {

// A grid of equally many cells on each axis of a region; a box belongs to the cell of its centre.
// An axis on which the region is flat has one cell, and its bits go to the other axes.
class HilbertGrid {
 public:
  // The region is given in doubled centres (min + max of a box): finite, low <= high. A place has
  // at most `code_bits` bits, 3 <= code_bits <= 30.
  HilbertGrid(const std::array<float, 3>& low, const std::array<float, 3>& high, int code_bits);

  int code_bits() const { return axes_ * bits_; }
  // Writes the place of boxes[i]'s centre to codes[i]. The codes are equal at every level of vector
  // instructions. An empty box gets an arbitrary code.
  void codes(std::span<const Aabb> boxes, std::uint32_t* codes) const;

 private:
  std::array<float, 3> low_, scale_;
  std::array<std::size_t, 3> axis_;  // the axes with more than one cell come first
  int axes_ = 0;
  int bits_ = 0;  // number for each axis
};

}  // namespace touchstone
