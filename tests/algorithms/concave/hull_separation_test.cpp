// Planes between hulls: none where the meshes share a point, and one where a gap is wide.
#include "algorithms/concave/part_pairs/hull_separation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::body_of;
using reference::moved_by;

bool parts(const std::array<ConcaveBody, 2>& bodies, const Pose& a, const Pose& b) {
  const std::vector<BoundBody> bound = {BoundBody(bodies[0]), BoundBody(bodies[1])};
  HullSeparation hulls;
  hulls.bind(bound);
  return hulls.parts({0, a}, {1, b});
}

TEST(HullSeparation, PolytopesHoldTheirPoints) {
  reference::Random random(1);
  for (int i = 0; i < 30; ++i) {
    std::vector<Vec3d> points;
    const Vec3d away = random.vector(i % 3);
    for (int k = 0; k < 40; ++k)
      points.push_back(away + random.vector(1).cwiseProduct(Vec3d(1, 0.3, i % 2)));
    const DiscretePolytope polytope(points);
    for (int k = 0; k < 200; ++k) {
      Vec3d way = random.vector(1);
      for (int axis = 0; axis < 3; ++axis) {
        if (k % 5 == axis) way[axis] = 0;
      }
      double end = -100;
      for (const Vec3d& p : points) end = std::max(end, way.dot(p));
      const auto part = [&](int axis) { return static_cast<float>(way[axis]); };
      const DiscretePolytope::Vector asked = {part(0), part(1), part(2), 0};
      const DiscretePolytope::Vector found = polytope.support(asked);
      EXPECT_GE(way.dot(Vec3d(found[0], found[1], found[2])), end - 1e-5);
    }
  }
}

// At scales and places of all sizes, in poses that stretch a little too.
TEST(HullSeparation, NeverPartsWhatMeets) {
  reference::Random random(2);
  const std::array<ConcaveBody, 2> tori = {body_of(reference::torus(12, 6, 1, 0.3)),
                                           body_of(reference::torus(16, 8, 1, 0.4))};
  int parted = 0, met = 0;
  const int count = drawn(300, 60);
  for (int i = 0; i < count; ++i) {
    const double scale = std::pow(10.0, i % 13 - 6);
    const double stretch = i % 2 == 0 ? 1 : 1 + 1e-7;
    const Pose a = {random.rotation() * scale, scale * random.vector(1)};
    const Pose b = {stretch * scale * random.rotation(),
                    Vec3d(a.translation + scale * random.vector(2))};
    const bool meets = reference::ask("part-pairs", ConcaveTask::intersect, tori, a, b).meets();
    const bool found = parts(tori, a, b);
    EXPECT_FALSE(found && meets) << i;
    parted += found;
    met += meets;
  }
  EXPECT_GT(parted, count / 8);
  EXPECT_GT(met, count / 8);
}

// Two balls of many triangles, of which one touches the other in a corner: doubles tell of no gap.
TEST(HullSeparation, NeverPartsWhatTouches) {
  const ConcaveBody ball = body_of(reference::torus(16, 8, 1, 0.5));
  double end = 0;
  for (const Vec3d& v : ball.mesh->vertices) end = std::max(end, v[0]);
  const std::array<ConcaveBody, 2> bodies = {ball, ball};
  for (const double gap : {0.0, -1e-12, -1e-6, -1e-3}) {
    EXPECT_FALSE(parts(bodies, {}, moved_by({2 * end + gap, 0, 0}))) << gap;
  }
  EXPECT_TRUE(parts(bodies, {}, moved_by({2 * end + 1e-3, 0, 0})));
  EXPECT_TRUE(parts(bodies, moved_by({2 * end + 1e-3, 0, 0}), {}));
}

TEST(HullSeparation, TellsNothingWhereFloatsEnd) {
  const ConcaveBody body = body_of(reference::torus(16, 8, 1, 0.5));
  const std::array<ConcaveBody, 2> bodies = {body, body};
  for (const double scale : {1e-300, 1e-40, 1e40, 1e300}) {
    const Pose here = {scale * Mat3d::Identity(), Vec3d::Zero()};
    const Pose there = {scale * Mat3d::Identity(), Vec3d(10 * scale, 0, 0)};
    EXPECT_FALSE(parts(bodies, here, there)) << scale;
  }
  EXPECT_FALSE(parts(bodies, {}, {}));
}

}  // namespace
}  // namespace touchstone
