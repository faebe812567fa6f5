// The closest point of a triangle: over its face, or on an edge.
// Paper: Ericson, "Real-time collision detection", 2005, 5.1.
#include "algorithms/kernels/rays/points/closest_of.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace touchstone {
namespace {

// The point of the triangle's plane that is nearest to p is a + v ab + w ac.
struct Weights {
  double v, w;

  bool inside() const { return v > 0 && w > 0 && v + w < 1; }
};
// `to` is p - a; the normal is ab x ac, and its square is not zero.
Weights weights_of(const Vec3d& to, const Vec3d& ab, const Vec3d& ac, const Vec3d& normal,
                   double square) {
  return {to.cross(ac).dot(normal) / square, ab.cross(to).dot(normal) / square};
}

// The nearest point of the plane, if it is in the triangle. The normal of a thin triangle is off by a
// part of itself, about the rounding over the sine of its angle at a, and the weights with it. What is
// left of p - a gives their correction, which is off by the same part of itself.
std::optional<Vec3d> closest_inside(const Vec3d& p, const Vec3d& a, const Vec3d& ab,
                                    const Vec3d& ac, bool& thin) {
  const Vec3d normal = ab.cross(ac);
  const double square = normal.squaredNorm();
  thin = !(square > 0.01 * ab.squaredNorm() * ac.squaredNorm());
  if (!(square > 0)) return std::nullopt;
  Weights weights = weights_of(p - a, ab, ac, normal, square);
  constexpr int most_corrections = 8;
  for (int i = 0; thin && i < most_corrections; ++i) {
    const Vec3d left = p - (a + weights.v * ab + weights.w * ac);
    const auto [v, w] = weights_of(left, ab, ac, normal, square);
    weights = {weights.v + v, weights.w + w};
    if (std::abs(v) + std::abs(w) < 0x1p-52) break;
  }
  if (!weights.inside()) return std::nullopt;
  return a + weights.v * ab + weights.w * ac;
}

}  // namespace

Vec3d closest_of(const Vec3d& p, const std::array<Vec3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  bool thin = false;
  const std::optional<Vec3d> inside = closest_inside(p, a, b - a, c - a, thin);
  if (inside && !thin) return *inside;
  Vec3d best = inside.value_or(a);
  double least = (p - best).squaredNorm();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &from = corners[k], &end = corners[(k + 1) % 3];
    const Vec3d edge = end - from;
    const double length = edge.squaredNorm();
    if (!(length > 0)) continue;
    const double s = std::clamp((p - from).dot(edge) / length, 0.0, 1.0);
    const Vec3d at = s < 1 ? Vec3d(from + s * edge) : end;
    const double away = (p - at).squaredNorm();
    if (away < least) {
      least = away;
      best = at;
    }
  }
  return best;
}

}  // namespace touchstone
