// Axis-aligned bounding boxes: what every broad phase is given.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace touchstone {

// Closed box [min, max] in world coordinates (metres). Boxes that touch overlap.
// Floats, rounded outward once when the scene is made; every broad phase and every peer is given
// these same bits, so their pair sets can be compared as sets.
struct Aabb {
  std::array<float, 3> min;
  std::array<float, 3> max;

  // The box of no body: it overlaps nothing, and its slot is to be skipped.
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

// The greatest float <= x, the least float >= x. Infinite where x is beyond the float's range.
inline float round_down(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                    : f;
}
inline float round_up(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace touchstone
