// What a separating plane that both bodies carry keeps, with its rounding; and the choice of the
// level of vector instructions of carried_plane.inl.
#include "algorithms/kernels/gjk/carried_plane.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

// Four numbers fill no wider vectors.
#if !defined(TOUCHSTONE_TWO_LEVELS)
#define TOUCHSTONE_TWO_LEVELS
#endif
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using simd::Quad;

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/gjk/carried_plane.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

Vec3d read(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

CarriedPlane CarriedPlane::make(const Vec3d& normal, double gap, double radius_a,
                                const Pose& pose_a, double radius_b, const Pose& pose_b) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  // The nearest float is off by half a unit in the last place, or by half the least float.
  const auto above = [](double x) {
    return static_cast<float>(x + (0x1p-23 * std::abs(x) + 0x1p-149));
  };
  CarriedPlane plane;
  const Vec3d in_a = pose_a.rotation.transpose() * normal;
  const Vec3d in_b = pose_b.rotation.transpose() * normal;
  for (int k = 0; k < 3; ++k) {
    plane.in_a_[k] = static_cast<float>(in_a[k]);
    plane.in_b_[k] = static_cast<float>(in_b[k]);
  }
  // Along `normal` the bodies are apart by `gap`; the normals that are kept are off by rounding: a
  // component by 2^-24 of it, or half the least float.
  const Vec3d offset = pose_b.translation - pose_a.translation;
  const double lost = 0x1p-24 * (radius_a * in_a.lpNorm<1>() + radius_b * in_b.lpNorm<1>()) +
                      0x1p-149 * (radius_a + radius_b);
  plane.radius_a_ = above(radius_a);
  plane.radius_b_ = above(radius_b);
  // What rounding takes of radii, here and in the test, belongs to the reach.
  const double radii = double{plane.radius_a_} + double{plane.radius_b_};
  const double reach =
      normal.dot(offset) - gap + lost + rounding * (2 * offset.lpNorm<1>() + 16 * radii);
  plane.reach_ = gap > 0 ? above(reach) : infinity;
  const bool is_finite = read(plane.in_a_).allFinite() && read(plane.in_b_).allFinite() &&
                         plane.radius_a_ < infinity && plane.radius_b_ < infinity &&
                         plane.reach_ > -infinity && !std::isnan(plane.reach_);
  if (!is_finite) return {};
  plane.sum_ = plane.sum();
  return plane;
}

bool CarriedPlane::parts(const Pose& pose_a, const Pose& pose_b, double margin) const {
  const auto parts_now = isa() == Isa::baseline ? baseline::parts_at : avx2::parts_at;
  return parts_now(*this, pose_a, pose_b, margin);
}

Vec3d CarriedPlane::normal(const Pose& pose_a, const Pose& pose_b) const {
  const Vec3d between = pose_a.rotation * read(in_a_) + pose_b.rotation * read(in_b_);
  const double squared = between.squaredNorm();
  const bool usable = squared > 0.5 && squared < 5;
  return usable ? Vec3d(between / std::sqrt(squared)) : Vec3d::Zero();
}

}  // namespace touchstone
