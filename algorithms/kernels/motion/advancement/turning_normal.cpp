// Features from the corners of a simplex.
#include "algorithms/kernels/motion/advancement/turning_normal.h"

#include <array>
#include <cmath>

namespace touchstone {
namespace {

// The different corners of one body in a simplex of at most three points.
struct Corners {
  int count = 0;
  std::array<Vec3d, 3> at{};

  void add(const Vec3d& corner) {
    for (int i = 0; i < count; ++i) {
      if (at[static_cast<std::size_t>(i)] == corner) return;
    }
    at[static_cast<std::size_t>(count++)] = corner;
  }
};

}  // namespace

Vec3d turning_of_normal(const Simplex<double>& nearest, const Vec3d& normal, const Vec3d& turn_a,
                        const Vec3d& turn_b) {
  if (nearest.size != 3) return Vec3d::Zero();
  Corners of_a, of_b;
  for (std::size_t i = 0; i < 3; ++i) {
    of_a.add(nearest.points[i].a);
    of_b.add(nearest.points[i].b);
  }
  if (of_a.count == 3 && of_b.count == 1) return turn_a;
  if (of_b.count == 3 && of_a.count == 1) return turn_b;
  if (of_a.count != 2 || of_b.count != 2) return Vec3d::Zero();
  return turning_across_edges(of_a.at[1] - of_a.at[0], of_b.at[1] - of_b.at[0], normal, turn_a,
                              turn_b);
}

Vec3d turning_across_edges(const Vec3d& edge_a, const Vec3d& edge_b, const Vec3d& normal,
                           const Vec3d& turn_a, const Vec3d& turn_b) {
  const Vec3d across = edge_a.cross(edge_b);
  constexpr double nearly_parallel = 0.05;
  const double square = across.squaredNorm();
  if (!(square > nearly_parallel * nearly_parallel * edge_a.squaredNorm() * edge_b.squaredNorm())) {
    return Vec3d::Zero();
  }
  // n' = (the change of the cross product) / its length, less what is along n; and n x n' turns n so.
  const double sense = across.dot(normal) < 0 ? -1 : 1;
  const Vec3d change = turn_a.cross(edge_a).cross(edge_b) + edge_a.cross(turn_b.cross(edge_b));
  return normal.cross(sense / std::sqrt(square) * change) +
         0.5 * normal.dot(turn_a + turn_b) * normal;
}

}  // namespace touchstone
