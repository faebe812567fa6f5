// Moller's test of two triangles.
//
// Steps: 1. No corner of one is on the other side of the other's plane: apart.
//        2. The line in which the planes cross meets each triangle in an interval; they are compared
//           along the axis on which the line is longest.
//        3. Triangles in one plane: an edge crosses an edge, or a corner of one is in the other.
// Departs: the paper's code sets heights below 1e-6 to zero; here each is taken as it comes.
// Fails:   where rounding hides the sign of a height or the order of two ends. Triangles that touch,
//          nearly touch or lie nearly in one plane are decided either way, and so are those without
//          area, which have no plane.
#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/concave/part_pairs/flat_test.h"
#include "algorithms/concave/part_pairs/mesh_pairs.h"

namespace touchstone {
namespace {

struct Interval {
  double low, high;
};

// Where the triangle meets the line of both planes: `along` are the corners' places on the line's
// axis, `height` their heights over the other plane, which are not all of one sign.
Interval interval(const Vec3d& along, const Vec3d& height) {
  // The corner that is alone on its side, or in the plane.
  int alone = 0;
  for (int k = 0; k < 3; ++k) {
    const double next = height[(k + 1) % 3], last = height[(k + 2) % 3];
    if (next * last > 0 || (height[k] != 0 && next * last >= 0 && height[k] * (next + last) <= 0)) {
      alone = k;
      break;
    }
  }
  std::array<double, 2> ends;
  for (int e = 0; e < 2; ++e) {
    const int other = (alone + 1 + e) % 3;
    const double drop = height[alone] - height[other];
    ends[e] = drop == 0 ? along[other]
                        : along[alone] + (along[other] - along[alone]) * height[alone] / drop;
  }
  return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

bool is_one_side(const Vec3d& height) { return height.minCoeff() > 0 || height.maxCoeff() < 0; }

}  // namespace

int test_by_moller(const TriangleCorners& a, const TriangleCorners& b, double) {
  const Vec3d normal_b = (b[1] - b[0]).cross(b[2] - b[0]);
  const Vec3d normal_a = (a[1] - a[0]).cross(a[2] - a[0]);
  Vec3d height_a, height_b;
  for (int k = 0; k < 3; ++k) {
    height_a[k] = normal_b.dot(a[k] - b[0]);
    height_b[k] = normal_a.dot(b[k] - a[0]);
  }
  if (is_one_side(height_a) || is_one_side(height_b)) return 0;
  if (height_a == Vec3d::Zero() || height_b == Vec3d::Zero()) {
    return flat_test(a, b, normal_a.squaredNorm() > 0 ? normal_a : normal_b) ? 1 : 0;
  }
  int axis = 0;
  normal_a.cross(normal_b).cwiseAbs().maxCoeff(&axis);
  const Interval on_a = interval({a[0][axis], a[1][axis], a[2][axis]}, height_a);
  const Interval on_b = interval({b[0][axis], b[1][axis], b[2][axis]}, height_b);
  return on_a.low <= on_b.high && on_b.low <= on_a.high ? 1 : 0;
}

}  // namespace touchstone
