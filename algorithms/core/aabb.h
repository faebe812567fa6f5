// Axis-aligned bounding boxes: the input of every broad phase. Everything may include this.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace touchstone {

// Closed box [min, max] in world coordinates (metres). Boxes that touch overlap.
// Coordinates are floats, rounded outward once when the scene is made. Every broad phase and every
// peer gets these bits, so their pair sets can be compared as sets.
struct Aabb {
  std::array<float, 3> min;
  std::array<float, 3> max;

  // The empty box of a slot without a body. It overlaps nothing, and algorithms skip its slot.
  static constexpr Aabb empty() {
    constexpr float inf = std::numeric_limits<float>::infinity();
    return {{inf, inf, inf}, {-inf, -inf, -inf}};
  }
  constexpr bool is_empty() const { return min[0] > max[0]; }

  friend constexpr bool operator==(const Aabb&, const Aabb&) = default;
};

// True when the closed boxes share a point. False when either is empty.
constexpr bool overlap(const Aabb& a, const Aabb& b) {
  return a.min[0] <= b.max[0] && b.min[0] <= a.max[0] &&  //
         a.min[1] <= b.max[1] && b.min[1] <= a.max[1] &&  //
         a.min[2] <= b.max[2] && b.min[2] <= a.max[2];
}

// The greatest float <= x, and the least float >= x; infinite if x is beyond the float's range. A
// conversion is off to either side half of the time, which no branch predicts, so none is taken: the
// next float is the next pattern of bits. A zero that is off has the sign of x, and steps to the
// least number of that sign.
inline float round_down(double x) {
  const float f = static_cast<float>(x);
  const auto bits = std::bit_cast<std::uint32_t>(f);
  const std::uint32_t is_above = static_cast<double>(f) > x ? 1 : 0;
  const std::uint32_t away = 2 * (bits >> 31) - 1;  // -1 for a positive float, 1 for a negative one
  return std::bit_cast<float>(bits + is_above * away);
}
inline float round_up(double x) { return -round_down(-x); }

}  // namespace touchstone
