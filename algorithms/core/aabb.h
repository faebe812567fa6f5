// Axis-aligned bounding boxes: the input of every broad phase. Everything may include this.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

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

// Returns the next number below x if x is to step, else x. A rounding is off to either side half of the
// time, which no branch predicts, so none is taken: the next number is the next pattern of bits. x is
// no NaN, and +0 does not step.
template <class Float>
Float step_down_if(bool steps, Float x) {
  using Bits = std::conditional_t<sizeof(Float) == 4, std::uint32_t, std::uint64_t>;
  const auto bits = std::bit_cast<Bits>(x);
  const Bits is_negative = bits >> (8 * sizeof(Float) - 1);
  return std::bit_cast<Float>(bits + (steps ? Bits{1} : Bits{0}) * (2 * is_negative - 1));
}

// The greatest float <= x, and the least float >= x; infinite if x is beyond the float's range.
inline float round_down(double x) {
  const float f = static_cast<float>(x);  // a zero that is above x is -0
  return step_down_if(static_cast<double>(f) > x, f);
}
inline float round_up(double x) { return -round_down(-x); }

}  // namespace touchstone
