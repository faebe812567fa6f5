// The signs that decide whether a triangle is above a point.
#include "algorithms/kernels/rays/points/winding_query.h"

#include <cmath>

namespace touchstone {
namespace {

constexpr double unit = 0x1p-53;
// Shewchuk's bounds for his orient2d and orient3d, in parts of the sum of the products' magnitudes.
constexpr double area_bound = (3 + 16 * unit) * unit;
constexpr double volume_bound = (7 + 56 * unit) * unit;
// Below this products may have lost digits to underflow.
constexpr double least_sure = 0x1p-900;

bool all_safe(const Vec3d& v) { return is_safe(v[0]) && is_safe(v[1]) && is_safe(v[2]); }

int sign_of(double x) { return x > 0 ? 1 : (x < 0 ? -1 : 0); }

}  // namespace

// The sign of the volume that a, b and c span, seen from the point.
int WindingQuery::volume_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d u = a - point_, v = b - point_, w = c - point_;
  double volume = 0, magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double first = v[i] * w[j], second = v[j] * w[i];
    volume += u[k] * (first - second);
    magnitude += std::abs(u[k]) * (std::abs(first) + std::abs(second));
  }
  if (magnitude > least_sure && std::abs(volume) > volume_bound * magnitude) return sign_of(volume);
  if (!all_safe(a) || !all_safe(b) || !all_safe(c) || !all_safe(point_)) {
    undecided_ = true;
    return 0;
  }
  return dot(exact_difference(a, point_),
             cross(exact_difference(b, point_), exact_difference(c, point_)))
      .sign();
}

// The sign of the area of the point with a and b, seen from above; of the moved point, if that of the
// point itself is zero. 0 only if a is above b.
int WindingQuery::area_sign(const Vec3d& a, const Vec3d& b) {
  const double left = (a[0] - point_[0]) * (b[1] - point_[1]);
  const double right = (a[1] - point_[1]) * (b[0] - point_[0]);
  const double area = left - right, magnitude = std::abs(left) + std::abs(right);
  if (magnitude > least_sure && std::abs(area) > area_bound * magnitude) return sign_of(area);
  if (!all_safe(a) || !all_safe(b) || !all_safe(point_)) {
    undecided_ = true;
    return 0;
  }
  const auto from = [&](const Vec3d& v, int k) {
    return FloatExpansion::difference(v[k], point_[k]);
  };
  const int exact = (from(a, 0) * from(b, 1) - from(a, 1) * from(b, 0)).sign();
  if (exact != 0) return exact;
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
  return sign_of(b[0] - a[0]);
}

bool WindingQuery::offer(std::uint32_t triangle, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const int volume = volume_sign(a, b, c);
  if (volume == 0) {
    // The point is in the triangle's plane, or the triangle has no area.
    RayQuery at({point_, Vec3d::UnitZ(), 0});
    if (at.offer(triangle, a, b, c)) {
      is_on_surface_ = true;
      return true;
    }
    undecided_ |= at.hit().status != Status::ok;
    return false;
  }
  const int side = area_sign(a, b);
  if (side == 0 || side != area_sign(b, c) || side != area_sign(c, a)) return false;
  if (volume == side) winding_ += side;
  return false;
}

}  // namespace touchstone
