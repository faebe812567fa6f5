// Guigue's and Devillers' test of two triangles.
//
// Steps: 1. No corner of one is on the other side of the other's plane: apart.
//        2. Turn each triangle so that its first corner is alone on its side, and flip the other so
//           that this side is the positive one.
//        3. The two intervals on the line in which the planes cross overlap if two volumes of a corner
//           and an edge are not positive.
//        4. Triangles in one plane are tested there.
// Fails: where rounding hides the sign of a volume. Triangles that touch, nearly touch or lie nearly in
//        one plane are decided either way, and so are those without area, which have no plane.
#include <array>
#include <utility>

#include "algorithms/concave/part_pairs/flat_test.h"
#include "algorithms/concave/part_pairs/mesh_pairs.h"

namespace touchstone {
namespace {

double volume(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// Turns the triangle so that its first corner is alone on its side, and returns true if this is the
// negative side. A corner in the plane is alone if both others are on one side.
bool turn_alone_first(TriangleCorners& t, const Vec3d& height) {
  for (int k = 0; k < 3; ++k) {
    const double own = height[k], next = height[(k + 1) % 3], last = height[(k + 2) % 3];
    const bool above = (own > 0 && next <= 0 && last <= 0) || (own == 0 && next < 0 && last < 0);
    const bool below = (own < 0 && next >= 0 && last >= 0) || (own == 0 && next > 0 && last > 0);
    if (!above && !below) continue;
    t = {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
    return below;
  }
  return false;
}

}  // namespace

int test_by_guigue_devillers(const TriangleCorners& a, const TriangleCorners& b, double) {
  Vec3d height_a, height_b;
  for (int k = 0; k < 3; ++k) {
    height_a[k] = volume(b[0], b[1], b[2], a[k]);
    height_b[k] = volume(a[0], a[1], a[2], b[k]);
  }
  const auto is_one_side = [](const Vec3d& h) { return h.minCoeff() > 0 || h.maxCoeff() < 0; };
  if (is_one_side(height_a) || is_one_side(height_b)) return 0;
  if (height_a == Vec3d::Zero() || height_b == Vec3d::Zero()) {
    const Vec3d normal_a = (a[1] - a[0]).cross(a[2] - a[0]);
    return flat_test(a, b, normal_a.squaredNorm() > 0 ? normal_a : (b[1] - b[0]).cross(b[2] - b[0]))
               ? 1
               : 0;
  }
  TriangleCorners p = a, q = b;
  const bool flip_q = turn_alone_first(p, height_a), flip_p = turn_alone_first(q, height_b);
  if (flip_q) std::swap(q[1], q[2]);
  if (flip_p) std::swap(p[1], p[2]);
  return volume(p[0], p[1], q[0], q[1]) <= 0 && volume(p[0], p[2], q[2], q[0]) <= 0 ? 1 : 0;
}

}  // namespace touchstone
