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

  // The sum over the numbers is that of their bits times these factors, modulo 2^32 - 1, plus one,
  // so that zeros have another one than zero. No factor is another one times a power of two or its
  // negative, so one or two changed bits change the sum; factors have 28 bits, so nine products fit
  // 64 bits. plane_lanes.inl makes the same sum. The factors are our own choice.
  static constexpr std::array<std::uint32_t, 9> factors{0xd2e6b43, 0xf2a74df, 0xa69e0d3,
                                                        0xe513271, 0xa6a3a45, 0x8c5c7fd,
                                                        0x928b2f3, 0xd23f083, 0x892f903};
  static constexpr std::uint64_t sum_of_zeros = 1;

 private:
  std::uint32_t sum() const;

  // carried_plane.inl and plane_lanes.inl read these ten numbers in this order.
  std::array<float, 3> in_a_{}, in_b_{};  // the normal from a to b in the axes of either body
  float reach_ = 0;  // metres: how far both bodies reach along it, together, and rounding in radii
  float radius_a_ = 0, radius_b_ = 0;  // metres: greatest distance of a point from the origin
  std::uint32_t sum_ = 0;
};

inline std::uint32_t CarriedPlane::sum() const {
  static_assert(sizeof(CarriedPlane) == 4 * (factors.size() + 1));
  std::uint64_t sum = sum_of_zeros;
  for (std::size_t k = 0; k < factors.size(); ++k) {
    std::uint32_t word;
    std::memcpy(&word, reinterpret_cast<const std::byte*>(this) + k * sizeof word, sizeof word);
    sum += std::uint64_t{factors[k]} * word;
  }
  // The upper half weighs 2^32, which is 1 modulo 2^32 - 1.
  for (int turn = 0; turn < 2; ++turn) sum = (sum >> 32) + (sum & 0xffffffff);
  return static_cast<std::uint32_t>(sum);
}

// The plane that was copied to the begin of a pair's memory.
inline const CarriedPlane& carried_plane_at(const std::byte* memory) {
  return *std::launder(reinterpret_cast<const CarriedPlane*>(memory));
}

}  // namespace touchstone
