// Hulls so large that no power of two brings their coordinates below 1.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {
namespace {

TEST(HugeHull, HasFloatsOnlyWhereCoordinatesAreAtMostOne) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> directions(100);
  for (Vec3d& d : directions)
    d = Vec3d(normal(random), normal(random), normal(random)).normalized();
  for (const double size : {1e-300, 1.0, 1e280, 1e290, 1e300}) {
    std::vector<Vec3d> points;
    for (const Vec3d& d : directions) points.push_back(size * d);
    const SupportShape<double> shape(hull_of(std::move(points)));
    ASSERT_EQ(shape.corners.size(), directions.size());
    const bool is_small = size < 1e285;
    EXPECT_EQ(shape.rough.empty(), !is_small) << size;
    if (!is_small) continue;
    for (const auto& corner : shape.corners) {
      EXPECT_LE(Vec3d(corner.x, corner.y, corner.z).cwiseAbs().maxCoeff(), 1) << size;
    }
  }
}

}  // namespace
}  // namespace touchstone
