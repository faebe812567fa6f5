// Tests the oracle's answers of bodies that are swept along a path.
#include <gtest/gtest.h>

#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/families/moving_pairs.h"
#include "tests/algorithms/oracle/samples.h"

namespace touchstone::oracle {
namespace {

using families::hull_shape;
using families::round_shape;

Body swept(Body body, const Vec3d& to, const Vec3d& from) {
  body.sweep = {to, from};
  return body;
}

Vec3d on_grid(int reach, Random& random) {
  Vec3d v;
  for (double& x : v) x = 0.25 * (random.below(2 * reach + 1) - reach);
  return v;
}

std::vector<Vec3d> grid_vertices(Random& random) {
  std::vector<Vec3d> vertices;
  for (int i = random.below(10); i >= 0; --i) vertices.push_back(on_grid(4, random));
  return vertices;
}

// On a grid, what a polytope sweeps is a polytope whose corners are doubles.
TEST(Sweep, OfAPolytopeIsThatOfItsCornersAtBothEnds) {
  Random random(51);
  Oracle oracle;
  int apart = 0, deep = 0;
  for (int i = 0; i < drawn(2000, 300); ++i) {
    const std::vector<Vec3d> vertices = grid_vertices(random);
    std::vector<Vec3d> both = vertices;
    const Vec3d way = on_grid(8, random);
    for (const Vec3d& v : vertices) both.emplace_back(v + way);
    const Solid a(hull_shape(vertices)), whole(hull_shape(both));
    const Solid b(i % 3 == 0   ? round_shape(ShapeKind::sphere, 0.5, 0)
                  : i % 3 == 1 ? families::box_shape({0.5, 0.25, 1})
                               : hull_shape(grid_vertices(random)));
    Pose pose_a, pose_b;
    pose_a.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    pose_a.translation = on_grid(4, random);
    pose_b.translation = on_grid(7, random);
    // The difference of both ends is exact, however far they are.
    const Vec3d from = i % 2 == 0 ? Vec3d(0x1p40, -0x1p30, 0x1p20) : Vec3d::Zero();
    const Vec3d to = pose_a.rotation * way + from;
    const Body body(b, pose_b), expected(whole, pose_a);
    const Measure own = oracle.measure(swept({a, pose_a}, to, from), body);
    const Measure other = oracle.measure(expected, body);
    EXPECT_EQ(own.answer, other.answer) << i;
    EXPECT_EQ(own.lower, other.lower) << i;
    EXPECT_EQ(own.upper, other.upper) << i;
    EXPECT_TRUE(own.exact);
    EXPECT_EQ(oracle.verdict(swept({a, pose_a}, to, from), body), other.answer) << i;
    const Measure back = oracle.measure(body, swept({a, pose_a}, to, from));
    EXPECT_EQ(back.lower, other.lower) << i;
    const Vec3d n = random.direction();
    const Enclosure along = separation_along(swept({a, pose_a}, to, from), body, n);
    EXPECT_EQ(along.upper, separation_along(expected, body, n).upper) << i;
    ++(own.lower > 0 ? apart : deep);
  }
  EXPECT_GT(apart, drawn(200, 30));
  EXPECT_GT(deep, drawn(200, 30));
}

// One body that moves past the other is the other that moves past it the other way.
TEST(Sweep, IsTheSameOfEitherBody) {
  Random random(52);
  Oracle oracle;
  int apart = 0, deep = 0;
  for (int i = 0; i < drawn(900, 150); ++i) {
    const auto regimes = exact_regimes();
    const Sample sample = i % 3 == 0   ? curved_sample(random, i)
                          : i % 3 == 1 ? halfspace_sample(random, i)
                                       : regimes[i / 3 % regimes.size()].make(random, i);
    const Body a = sample.a.body(), b = sample.b.body();
    const double size = 1 + (b.translation - a.translation).norm();
    const Vec3d to = size * random.vector(1), from = size * random.vector(1);
    const Measure own = oracle.measure(swept(a, to, from), b);
    const Measure other = oracle.measure(a, swept(b, from, to));
    SCOPED_TRACE(i);
    EXPECT_EQ(own.exact, other.exact);
    if (own.exact) {
      EXPECT_EQ(own.answer, other.answer);
      EXPECT_EQ(own.lower, other.lower);
      EXPECT_EQ(own.upper, other.upper);
    } else {
      EXPECT_LE(own.lower, other.upper);
      EXPECT_LE(other.lower, own.upper);
    }
    // It covers the body where it begins.
    const Measure still = oracle.measure(a, b);
    EXPECT_LE(own.lower, still.upper);
    if (still.exact && own.exact) {
      EXPECT_LE(own.upper, still.upper);
    }
    ++(own.lower > 0 ? apart : deep);
  }
  EXPECT_GT(apart, 20);
  EXPECT_GT(deep, 20);
}

TEST(Sweep, OfRoundBodiesAlongTheirAxis) {
  Random random(53);
  Oracle oracle;
  for (int i = 0; i < drawn(400, 80); ++i) {
    const bool ball = i % 2 == 0;
    Shape ellipsoid;
    ellipsoid.kind = ShapeKind::ellipsoid;
    ellipsoid.radii = Vec3d::Constant(0.75);
    const Solid own(ball ? ellipsoid : round_shape(ShapeKind::cylinder, 0.75, 0.5));
    const Solid longer(ball ? round_shape(ShapeKind::capsule, 0.75, 0.25)
                            : round_shape(ShapeKind::cylinder, 0.75, 0.75));
    const Solid box(families::box_shape({0.5, 0.25, 1}));
    Pose pose, whole, other;
    pose.translation = on_grid(4, random);
    whole.translation = pose.translation + Vec3d(0, 0, 0.25);
    other.translation = pose.translation + random.vector(2);
    other.rotation = random.rotation();
    const Measure found = oracle.measure(swept({own, pose}, {0, 0, 1.5}, {0, 0, 1}), {box, other});
    const Measure expected = oracle.measure({longer, whole}, {box, other});
    EXPECT_LE(found.lower, expected.upper) << i;
    EXPECT_LE(expected.lower, found.upper) << i;
    EXPECT_NEAR(found.lower, found.upper, 1e-9) << i;
  }
}

}  // namespace
}  // namespace touchstone::oracle
