// A separating plane that both bodies carry with them. Used by the warm start of gjk, gjk-lanes,
// ellipsoid and smooth; kernels/batch/plane_lanes.h tests many at once.
//
// A plane's normal is kept in the axes of either body. As long as the two turn to nearly the same
// direction in the world, the bodies reach as far along it as they did, whatever their shapes: no
// support point is asked for.
// Paper:   van den Bergen, "A fast and robust GJK implementation for collision detection of convex
//          objects", J. Graphics Tools 4(2), 1999, section 2.3.4 (the last separating axis is tried
//          first). That its extents need not be asked for again is ours: if d is the normal n seen
//          from a body now, and m the normal that it carries, then
//            max d . v <= max m . v + radius |d - m|
//          over all points v of the body, which are at most `radius` from its origin.
// Cost:    27 products in vectors of four; no access to a shape.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>

#include "algorithms/core/pose.h"

namespace touchstone {

// It is trivially copyable, and has 40 bytes. All zeros mean that there is none.
class CarriedPlane {
 public:
  // Makes one from a normal in the world of about unit length, along which the bodies are apart by
  // `gap` (metres; a lower bound). Radii are from the bodies' origins. Without a gap it carries the
  // direction alone; it is empty if a number overflows.
  static CarriedPlane make(const Vec3d& normal, double gap, double radius_a, const Pose& pose_a,
                           double radius_b, const Pose& pose_b);

  // Returns true if it proves that the bodies are apart by more than rounding, and by more than the
  // margin (metres).
  bool parts(const Pose& pose_a, const Pose& pose_b, double margin = 0) const;

  // The normal in the world, halfway between where the two bodies carried it: unit length, or zero
  // if there is none.
  Vec3d normal(const Pose& pose_a, const Pose& pose_b) const;

  // Returns true if `make` wrote it. A sum over the numbers tells that from anything else, so that
  // nothing else is believed.
  bool is_own() const { return sum() == sum_; }

  // All rounding errors of a bound together, as a part of the sum of all lengths. With matrices whose
  // entries are below two, that of a part of d is at most 36 u.
  static constexpr double rounding = 64 * 0x1p-53;

 private:
  std::uint32_t sum() const;

  // carried_plane.inl and plane_lanes.inl read these nine numbers in this order.
  std::array<float, 3> in_a_{}, in_b_{};  // the normal from a to b in the axes of either body
  float reach_ = 0;  // metres: how far both bodies reach along it, together, and rounding in radii
  float radius_a_ = 0, radius_b_ = 0;  // metres: greatest distance of a point from the origin
  std::uint32_t sum_ = 0;
};

inline std::uint32_t CarriedPlane::sum() const {
  static_assert(sizeof(CarriedPlane) == 5 * sizeof(std::uint64_t));
  const auto word = [this](std::size_t k) {
    std::uint64_t two;
    std::memcpy(&two, reinterpret_cast<const std::byte*>(this) + k * sizeof two, sizeof two);
    return two;
  };
  // An odd multiplier of our own choice, and an offset, so that zeros have a sum other than zero.
  constexpr std::uint64_t multiplier = 0x9e3779b97f4a7c15;
  std::uint64_t mixed = word(0) + 1;
  for (std::size_t k = 1; k < 4; ++k) mixed = mixed * multiplier + word(k);
  std::uint32_t radius_b;
  std::memcpy(&radius_b, &radius_b_, sizeof radius_b);
  return static_cast<std::uint32_t>((mixed * multiplier + radius_b) * multiplier >> 32);
}

// The plane that was copied to the begin of a pair's memory.
inline const CarriedPlane& carried_plane_at(const std::byte* memory) {
  return *std::launder(reinterpret_cast<const CarriedPlane*>(memory));
}

}  // namespace touchstone
