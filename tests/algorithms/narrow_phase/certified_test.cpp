// Certified against the oracle where doubles end: all scales, any matrix, bodies that touch, or
// nearly; and that its filter and the oracle both have a part in that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/bodies.h"

namespace touchstone::certified_test {
namespace {

using namespace test;

const NarrowPhaseEntry& certified() {
  const auto entries = registry::entries<NarrowPhaseEntry>();
  return *std::find_if(entries.begin(), entries.end(),
                       [](const auto& entry) { return entry.info.name == "certified"; });
}

Shape random_shape(ShapeKind kind, double size, Random& random) {
  const auto length = [&] { return size * uniform(random, 0.2, 1); };
  Shape shape;
  if (kind == ShapeKind::hull) {
    std::vector<Vec3d> vertices =
        random_hull(random, 4 + static_cast<int>(random() % 9)).hull->vertices;
    // Some are off their own origin, some are slivers.
    const Vec3d off = random() % 3 == 0 ? Vec3d(3 * random_direction(random)) : Vec3d(0, 0, 0);
    const double thick = random() % 4 == 0 ? 1e-9 : 1;
    for (Vec3d& v : vertices) v = size * (v.cwiseProduct(Vec3d(1, 1, thick)) + off);
    return bare_hull(std::move(vertices), 3);
  }
  shape.kind = kind;
  shape.radius = length();
  shape.half_length = length();
  shape.half_extents = {length(), length(), length()};
  shape.radii = {length(), length(), length()};
  shape.normal = random_direction(random) * uniform(random, 0.5, 2);
  shape.offset = size * uniform(random, -1, 1);
  return shape;
}

// A rotation, one of the axes' own, a stretched and sheared matrix, or a mirrored one.
Mat3d random_matrix(Random& random) {
  const Mat3d turned = random_rotation(random);
  switch (random() % 4) {
    case 0: return Mat3d::Identity();
    case 1: return turned;
    case 2: return turned + 0.2 * random_rotation(random);
    default: return -turned * uniform(random, 0.5, 2);
  }
}

struct Count {
  int filter = 0, oracle = 0, separated = 0, overlapping = 0, other = 0, open = 0;
};

// Every task's answer against the oracle's.
void compare(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, Count& count) {
  const oracle::Solid solid_a(a), solid_b(b);
  const oracle::Body body_a(solid_a, pose_a), body_b(solid_b, pose_b);
  oracle::Oracle oracle;
  const oracle::Measure exact = oracle.measure(body_a, body_b);
  for (const Task task : all_tasks) {
    const Outcome outcome = ask(certified(), {}, task, a, pose_a, b, pose_b);
    ++(outcome.support_calls < 0 ? count.oracle : count.filter);
    EXPECT_GE(outcome.iterations, 0);
    // Enclosures of curved cores depend on where they were sought: one may have zero in it, and the
    // other not.
    const bool curved = solid_a.is_curved() || solid_b.is_curved();
    const bool open = outcome.answer == Answer::unknown || exact.answer == Answer::unknown;
    if (!curved || !open) {
      ASSERT_EQ(outcome.answer, exact.answer) << exact.lower << " " << exact.upper;
    } else {
      ++count.open;
    }
    const bool wide = outcome.answer != Answer::unknown && outcome.status == Status::not_converged;
    ASSERT_TRUE(outcome.status == Status::ok || outcome.status == Status::not_converged);
    ASSERT_FALSE(outcome.status == Status::ok && outcome.answer == Answer::unknown);
    ASSERT_TRUE(!wide || (curved && asks_depth(task)));
    if (!std::isnan(outcome.distance)) {
      // The comparison holds for infinities too.
      ASSERT_LE(outcome.lower, outcome.distance);
      ASSERT_LE(outcome.distance, outcome.upper);
      ASSERT_LE(outcome.lower, exact.upper);
      ASSERT_GE(outcome.upper, exact.lower);
    }
  }
  ++(exact.answer == Answer::separated     ? count.separated
     : exact.answer == Answer::overlapping ? count.overlapping
                                           : count.other);
}

// Moves b until the bodies are `wanted` (metres) apart, as well as doubles can say.
void place(const Shape& a, const Pose& pose_a, const Shape& b, Pose& pose_b, double wanted) {
  const oracle::Solid solid_a(a), solid_b(b);
  oracle::Oracle oracle;
  for (int step = 0; step < 3; ++step) {
    const oracle::Measure now =
        oracle.measure(oracle::Body(solid_a, pose_a), oracle::Body(solid_b, pose_b));
    const double move = wanted - now.middle();
    if (!std::isfinite(move) || now.normal.isZero(0)) return;
    pose_b.translation += move * now.normal.stableNormalized();
  }
}

class CertifiedScale : public testing::TestWithParam<double> {};

TEST_P(CertifiedScale, EveryPairOfKindsAgreesWithTheOracle) {
  const double scale = GetParam();
  Random random(17);
  Count count;
  for (const ShapeKind kind_a : all_shape_kinds) {
    for (const ShapeKind kind_b : all_shape_kinds) {
      for (const double gap : {0.3, -0.1, 1e-9, -1e-9, 1e-15, -1e-15, 1e-16, 0.}) {
        const Shape a = random_shape(kind_a, scale, random),
                    b = random_shape(kind_b, scale, random);
        const Pose pose_a{random_matrix(random), scale * random_direction(random)};
        Pose pose_b{random_matrix(random), scale * random_direction(random)};
        place(a, pose_a, b, pose_b, gap * scale);
        SCOPED_TRACE(std::string(to_string(kind_a)) + " " + std::string(to_string(kind_b)));
        compare(a, pose_a, b, pose_b, count);
      }
    }
  }
  EXPECT_GT(count.filter, 300);
  EXPECT_GT(count.oracle, 150);
  EXPECT_LT(count.open, 200);
  EXPECT_GT(count.separated, 100);
  EXPECT_GT(count.overlapping, 100);
}
INSTANTIATE_TEST_SUITE_P(Certified, CertifiedScale,
                         testing::Values(1e-300, 1e-150, 1e-20, 1., 1e20, 1e150, 1e300));

TEST(Certified, KnowsTouchingFromBoth) {
  Count count;
  const Shape cube = box(1, 1, 1), ball = sphere(1);
  const double ulp = 0x1p-52;
  for (const double shift : {0., ulp, -ulp / 2}) {
    for (const Shape& b : {cube, box_as_hull(1, 1, 1), ball}) {
      Pose pose_b;
      pose_b.translation = {1 + 1 + 2 * shift, 0, 0};
      compare(cube, {}, b, pose_b, count);
      // The point is on a corner, with coordinates far from both origins.
      pose_b.translation = {1e8, 2 + 2 * shift, 0};
      Pose pose_a;
      pose_a.translation = {1e8, 0, 0};
      compare(cube, pose_a, b, pose_b, count);
    }
  }
  EXPECT_GE(count.other, 6);
  EXPECT_GE(count.separated, 6);
  EXPECT_GE(count.overlapping, 6);
}

TEST(Certified, CoincidentBodiesOverlap) {
  Random random(3);
  Count count;
  for (const ShapeKind kind : all_shape_kinds) {
    for (int k = 0; k < 4; ++k) {
      const Shape shape = random_shape(kind, 1, random);
      const Pose pose{random_matrix(random), random_direction(random)};
      compare(shape, pose, shape, pose, count);
    }
  }
  EXPECT_EQ(count.overlapping, 32);
}

TEST(Certified, HullsFarFromTheirOwnOrigin) {
  Random random(5);
  Count count;
  for (const double far : {1e3, 1e8, 1e12, 1e15}) {
    for (int k = 0; k < 20; ++k) {
      std::vector<Vec3d> vertices = random_hull(random, 8).hull->vertices;
      const Vec3d off = far * random_direction(random);
      for (Vec3d& v : vertices) v += off;
      const Shape a = bare_hull(std::move(vertices), 3),
                  b = random_shape(ShapeKind::box, 1, random);
      const Pose pose_a{random_rotation(random), Vec3d::Zero()};
      Pose pose_b{random_rotation(random), pose_a.rotation * off};
      place(a, pose_a, b, pose_b, k % 2 == 0 ? 1e-3 : -1e-3);
      compare(a, pose_a, b, pose_b, count);
    }
  }
  EXPECT_GT(count.filter, 60);
  EXPECT_GT(count.separated, 20);
  EXPECT_GT(count.overlapping, 20);
}

// The neighbours in a wrongly linked hull need not lead to the furthest vertex.
TEST(Certified, DoesNotTrustTheEdgesOfAHull) {
  Random random(7);
  Count count;
  auto made = std::make_shared<Hull>();
  for (int k = 0; k < 300; ++k) made->vertices.push_back(random_direction(random));
  for (std::uint32_t k = 0; k < 300; ++k) made->neighbours.push_back({(k + 1) % 300});
  const Shape linked = as_shape(made);
  for (int k = 0; k < 60; ++k) {
    const Pose pose_a{random_rotation(random), Vec3d::Zero()};
    const Pose pose_b{random_rotation(random), 1.98 * random_direction(random)};
    compare(linked, pose_a, linked, pose_b, count);
  }
  EXPECT_GT(count.separated, 10);
  EXPECT_GT(count.overlapping, 10);
}

// The disc of a cylinder and the ellipsoid's length are roots of squares that may vanish.
TEST(Certified, DirectionsThatAreNearlyAlongAnAxis) {
  Random random(9);
  Count count;
  for (const ShapeKind kind : {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid}) {
    for (const double tilt : {1e-150, 1e-162, 1e-170, 1e-300}) {
      Shape shape = random_shape(kind, 1, random);
      shape.radii.x() = tilt;
      Pose pose_b;
      for (const double gap : {1e-3, -1e-3, 0.5, -0.2}) {
        pose_b.translation = {tilt, -tilt, 2.5};
        place(shape, {}, box(1, 1, 1), pose_b, gap);
        compare(shape, {}, box(1, 1, 1), pose_b, count);
      }
    }
  }
  EXPECT_GT(count.separated, 15);
  EXPECT_GT(count.overlapping, 15);
}

}  // namespace
}  // namespace touchstone::certified_test
