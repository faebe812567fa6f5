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
// Cost:    27 products; no access to a shape.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

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

  // All rounding errors of a bound together, as a part of the sum of all lengths. With matrices of a
  // norm of at most four, that of a part of d is at most 24 u.
  static constexpr double rounding = 64 * 0x1p-53;
  // Both matrices' squares of all entries together are below this; rotations have six.
  static constexpr double greatest_squares = 16;

 private:
  std::uint32_t sum() const;

  // The lanes of plane_lanes.inl read these nine numbers in this order.
  std::array<float, 3> in_a_{}, in_b_{};  // the normal from a to b in the axes of either body
  float reach_ = 0;                       // metres: how far both bodies reach along it, together
  float radius_a_ = 0, radius_b_ = 0;     // metres: greatest distance of a point from the origin
  std::uint32_t sum_ = 0;
};

inline std::uint32_t CarriedPlane::sum() const {
  const auto two = [](float x, float y) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(y)} << 32 | std::bit_cast<std::uint32_t>(x);
  };
  // Odd multipliers of our own choice, and an offset, so that zeros have a sum other than zero.
  const std::uint64_t mixed =
      two(in_a_[0], in_a_[1]) * 0x9e3779b97f4a7c15 + two(in_a_[2], in_b_[0]) * 0xc2b2ae3d27d4eb4f +
      two(in_b_[1], in_b_[2]) * 0x165667b19e3779f9 + two(reach_, radius_a_) * 0xd6e8feb86659fd93 +
      two(1, radius_b_) * 0xff51afd7ed558ccd;
  return static_cast<std::uint32_t>(mixed >> 32);
}

// With n the normal as a carries it into the world, and d_a, d_b the differences of n seen from
// either body from what the body carries, the gap along n is at least
//   n . offset - reach - (|n| - 1) balls - radius_a |d_a| - radius_b |d_b|,
// where the balls are those that round the bodies' cores: they are part of the radii. Instead of
// the roots, x + y < g is tested by 2 (x^2 + y^2) < g^2.
inline bool CarriedPlane::parts(const Pose& pose_a, const Pose& pose_b, double margin) const {
  const double a0 = in_a_[0], a1 = in_a_[1], a2 = in_a_[2];
  const Mat3d& r = pose_a.rotation;
  const Mat3d& s = pose_b.rotation;
  const double x = r(0, 0) * a0 + r(0, 1) * a1 + r(0, 2) * a2;
  const double y = r(1, 0) * a0 + r(1, 1) * a1 + r(1, 2) * a2;
  const double z = r(2, 0) * a0 + r(2, 1) * a1 + r(2, 2) * a2;
  const auto off = [&](const Mat3d& m, const std::array<float, 3>& kept) {
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = m(0, k) * x + m(1, k) * y + m(2, k) * z - double{kept[k]};
      square += d * d;
    }
    return square;
  };
  const double off_a = off(r, in_a_), off_b = off(s, in_b_);
  const Vec3d offset = pose_b.translation - pose_a.translation;
  const double radius_a = radius_a_, radius_b = radius_b_, radii = radius_a + radius_b;
  const double length = offset.lpNorm<1>();
  const double excess = x * x + y * y + z * z - 1;
  const double gap = x * offset.x() + y * offset.y() + z * offset.z() - double{reach_} -
                     radii * std::abs(excess) - rounding * (2 * length + 8 * radii) -
                     (margin > 0 ? margin * (1 + std::abs(excess)) : 0);
  const double bend = radius_a * radius_a * off_a + radius_b * radius_b * off_b;
  constexpr double twice = 2 * (1 + rounding);
  return gap > 0 && gap * gap > twice * bend && excess < 1 &&
         r.squaredNorm() + s.squaredNorm() < greatest_squares && is_own();
}

}  // namespace touchstone
