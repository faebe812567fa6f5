// What excludes pairs of triangles from the oracle's integers, against the integers.
#include "algorithms/oracle/concave/triangle_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/concave/agreed.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using oracle::Body;
using oracle::Solid;

Solid solid_of(const TriangleMesh& mesh, std::size_t triangle) {
  Hull hull;
  for (const std::uint32_t corner : mesh.triangles[triangle]) {
    hull.vertices.push_back(mesh.vertices[corner]);
  }
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::make_shared<const Hull>(std::move(hull));
  return Solid(shape);
}

TEST(TriangleGap, IsAtMostTheDistanceAndReachesIt) {
  reference::Random random(1);
  oracle::Oracle exact;
  int met = 0, reached = 0;
  const int count = drawn(2000, 200);
  for (int i = 0; i < count; ++i) {
    TriangleMesh mesh;
    for (int k = 0; k < 6; ++k) mesh.vertices.push_back(random.vector(i % 2 == 0 ? 1 : 1000));
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const Solid first = solid_of(mesh, 0), second = solid_of(mesh, 1);
    const Body a(first, {random.rotation(), random.vector(1)});
    const Body b(second, {random.rotation(), random.vector(3)});
    const oracle::Measure truth = exact.measure(a, b);
    const oracle::RoundedTriangle in_a = rounded_triangle(a), in_b = rounded_triangle(b);
    const double along_normal = gap_along(truth.normal, in_a, in_b);
    EXPECT_LE(along_normal, std::max(0.0, truth.lower));
    EXPECT_LE(gap_along(random.vector(1), in_a, in_b), std::max(0.0, truth.lower));
    const double proven = proven_distance(in_a, in_b, std::numeric_limits<double>::infinity());
    EXPECT_LE(proven, std::max(0.0, truth.lower));
    EXPECT_LE(proven_distance(in_a, in_b, 0), proven);
    if (truth.lower <= 0) {
      ++met;
    } else {
      EXPECT_GE(proven, truth.upper * (1 - 1e-11) - 1e-10);
      EXPECT_GE(along_normal, truth.upper * (1 - 1e-11) - 1e-10);
      ++reached;
    }
  }
  EXPECT_GT(met, 0);
  EXPECT_GT(reached, 0);
}

TEST(TriangleGap, IsNothingWhereDoublesEnd) {
  const oracle::RoundedTriangle near = {{Vec3d::Zero(), Vec3d::UnitX(), Vec3d::UnitY()}, 0},
                                far = {{Vec3d(0, 0, 1e200), Vec3d(1, 0, 1e200), Vec3d(0, 1, 1e200)},
                                       0};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(gap_along(Vec3d::UnitZ(), near, far), 0);
  EXPECT_EQ(gap_along(Vec3d::Zero(), near, near), 0);
  EXPECT_EQ(gap_along(Vec3d(0, nan, 0), near, near), 0);
}

TEST(TriangleGap, LeavesTheNearestPairOfMeshes) {
  reference::Random random(2);
  oracle::Oracle exact;
  const std::array<ConcaveBody, 2> bodies = {reference::body_of(reference::torus(8, 4, 1, 0.2)),
                                             reference::body_of(reference::torus(6, 4, 0.8, 0.2))};
  int apart = 0;
  const int count = drawn(10, 2);
  for (int i = 0; i < count; ++i) {
    const Pose a = {random.rotation(), Vec3d::Zero()}, b = {random.rotation(), Vec3d(2.1, 0, 0)};
    const Outcome found = reference::ask("exact", ConcaveTask::distance, bodies, a, b).outcome;
    if (found.answer != Answer::separated) continue;
    ++apart;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < bodies[0].mesh->triangles.size(); ++t) {
      const Solid first = solid_of(*bodies[0].mesh, t);
      for (std::size_t s = 0; s < bodies[1].mesh->triangles.size(); ++s) {
        const Solid second = solid_of(*bodies[1].mesh, s);
        least = std::min(least, exact.measure(Body(first, a), Body(second, b)).upper);
      }
    }
    EXPECT_EQ(found.upper, least);
  }
  EXPECT_GT(apart, 0);
}

}  // namespace
}  // namespace touchstone
