// The closed forms at the places where a formula breaks: cores that meet, centres that coincide,
// gaps down to rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/bodies.h"

namespace touchstone::closed_form_test {
namespace {

using namespace test;

Shape capsule(double radius, double half_length) {
  Shape shape;
  shape.kind = ShapeKind::capsule;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}

Outcome closed_form(Precision scalar, Task task, const Shape& a, const Pose& pose_a, const Shape& b,
                    const Pose& pose_b) {
  return ask(*registry::find<NarrowPhaseEntry>("closed-form"), settings_of(scalar), task, a, pose_a,
             b, pose_b);
}

Mat3d turn(double angle, const Vec3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

// Distance (task distance) or minus the depth, with the invariants of the witness points.
double signed_distance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  Outcome outcome = closed_form(Precision::float64, Task::distance, a, pose_a, b, pose_b);
  if (outcome.answer != Answer::separated) {
    outcome = closed_form(Precision::float64, Task::penetration, a, pose_a, b, pose_b);
  }
  EXPECT_NEAR(outcome.normal.norm(), 1, 1e-14);
  const Vec3d between = outcome.witness_b - outcome.witness_a;
  EXPECT_LE((between - outcome.distance * outcome.normal).norm(), 1e-12);
  // Moved by it along the normal, the bodies touch along a plane.
  const double low = support(b, pose_b, -outcome.normal).dot(outcome.normal);
  const double high = support(a, pose_a, outcome.normal).dot(outcome.normal);
  EXPECT_NEAR(low - high, outcome.distance, 1e-12);
  return outcome.distance;
}

TEST(ClosedForm, CapsulesWhoseAxesMeet) {
  Random random(1);
  const Shape a = capsule(0.2, 1), b = capsule(0.3, 0.7);
  for (int k = 0; k < 300; ++k) {
    const Mat3d common = random_rotation(random);
    // The angle between them, and how far apart their lines are: down to nothing.
    const double angle = k % 5 == 0 ? 0 : std::pow(10.0, uniform(random, -16, 0));
    const double apart = k % 3 == 0 ? 0 : std::pow(10.0, uniform(random, -17, 0));
    const Pose pose_a{common, Vec3d(1, 2, 3)};
    const Pose pose_b{common * turn(angle, Vec3d::UnitX()),
                      pose_a.translation + common * Vec3d(apart, 0, 0)};
    EXPECT_NEAR(signed_distance(a, pose_a, b, pose_b), apart - 0.5, 1e-14) << angle << " " << apart;
  }
}

TEST(ClosedForm, CapsulesInLineAndAtTheirEnds) {
  Random random(2);
  const Shape a = capsule(0.25, 1), b = capsule(0.25, 0.5), ball = sphere(0.25);
  for (int k = 0; k < 100; ++k) {
    const Mat3d r = random_rotation(random);
    const double gap = std::pow(10.0, uniform(random, -12, 0)) * (k % 2 == 0 ? 1 : -0.4);
    const Pose at{r, Vec3d::Zero()};
    const auto along = [&](double z) { return Pose{r, r * Vec3d(0, 0, z)}; };
    const auto beside = [&](double x) { return Pose{r, r * Vec3d(x, 0, 0.3)}; };
    EXPECT_NEAR(signed_distance(a, at, b, along(2 + gap)), gap, 1e-14);
    EXPECT_NEAR(signed_distance(a, at, b, beside(0.5 + gap)), gap, 1e-14);
    EXPECT_NEAR(signed_distance(ball, at, a, along(1.5 + gap)), gap, 1e-14);
    EXPECT_NEAR(signed_distance(ball, at, a, beside(0.5 + gap)), gap, 1e-14);
    EXPECT_NEAR(signed_distance(ball, at, ball, beside(0.4)), 0, 1e-14);
  }
  EXPECT_NEAR(signed_distance(ball, {}, ball, {}), -0.5, 1e-14);
  EXPECT_NEAR(signed_distance(a, {}, a, {}), -0.5, 1e-14);
}

TEST(ClosedForm, SphereAndBox) {
  Random random(3);
  const Shape ball = sphere(0.25), block = box(1, 2, 3);
  for (int k = 0; k < 200; ++k) {
    const Pose pose{random_rotation(random), 1e3 * random_direction(random)};
    const auto at = [&](double x, double y, double z) {
      return Pose{Mat3d::Identity(), pose(Vec3d(x, y, z))};
    };
    const double gap = std::pow(10.0, uniform(random, -9, 0));
    // The ball's position is rounded at 1e3 from the origin.
    EXPECT_NEAR(signed_distance(ball, at(1.25 + gap, 0.3, -2), block, pose), gap, 1e-12);
    EXPECT_NEAR(signed_distance(ball, at(1.25 - 0.2 * gap, 0.3, -2), block, pose), -0.2 * gap,
                1e-12);
    EXPECT_NEAR(signed_distance(ball, at(-0.7, 0.3, 1), block, pose), -0.55, 1e-12);
    EXPECT_NEAR(signed_distance(ball, at(0.1, -1.95, 0), block, pose), -0.3, 1e-12);
    EXPECT_NEAR(signed_distance(ball, at(1, 0, 0), block, pose), -0.25, 1e-12);
    const double corner = 0.25 + gap;
    EXPECT_NEAR(
        signed_distance(ball, at(1 + corner * 2 / 7, 2 + corner * 3 / 7, 3 + corner * 6 / 7), block,
                        pose),
        gap, 1e-12);
  }
}

// In the places of the half plane where another formula holds, and at their bounds.
TEST(ClosedForm, SphereAndCylinderOrCone) {
  Random random(5);
  const Shape ball = sphere(0.25);
  for (int k = 0; k < 200; ++k) {
    Shape solid;
    solid.kind = k % 2 == 0 ? ShapeKind::cylinder : ShapeKind::cone;
    solid.radius = 3;
    solid.half_length = 2;
    const Pose pose{random_rotation(random), 1e3 * random_direction(random)};
    const double angle = uniform(random, 0, 6.3);
    const auto at = [&](double out, double up) {
      return Pose{Mat3d::Identity(), pose(Vec3d(out * std::cos(angle), out * std::sin(angle), up))};
    };
    const auto expect = [&](double out, double up, double distance) {
      EXPECT_NEAR(signed_distance(ball, at(out, up), solid, pose), distance - 0.25, 1e-12)
          << out << " " << up;
    };
    const double gap = std::pow(10.0, uniform(random, -9, 0));
    // Below the base, at its rim; on the axis a hair's breadth above it.
    expect(1.5, -2 - gap, gap);
    expect(0, -2 - gap, gap);
    expect(3 + 0.6 * gap, -2 - 0.8 * gap, gap);
    expect(1e-14 * gap, -1.9, -0.1);
    if (solid.kind == ShapeKind::cylinder) {
      expect(3 + gap, 0.5, gap);
      expect(1, 2 + gap, gap);
      expect(3 + 0.6 * gap, 2 + 0.8 * gap, gap);
      expect(3 - 0.2 * gap, 0, -0.2 * gap);
      expect(0.5, 0.25, -1.75);
      continue;
    }
    // The slant is from (3, -2) to (0, 2): its normal is (0.8, 0.6).
    expect(1.5 + 0.8 * gap, 0.6 * gap, gap);
    expect(3 + 0.8 * gap, -2 + 0.6 * gap, gap);
    expect(0, 2 + gap, gap);
    expect(0.28 * gap, 2 + 0.96 * gap, gap);
    expect(1.5 - 0.08 * gap, -0.06 * gap, -0.1 * gap);
    expect(0, 1, -0.6);
    expect(0.1, -1.5, -0.5);
  }
}

// Solids that are points or nearly so, at places whose squares vanish: the numbers stay numbers.
TEST(ClosedForm, SphereAndWhatIsNearlyAPoint) {
  int answered = 0;
  for (const ShapeKind kind : {ShapeKind::box, ShapeKind::cylinder, ShapeKind::cone}) {
    for (const double size : {0., 1e-30, 1e-22}) {
      Shape solid;
      solid.kind = kind;
      solid.radius = solid.half_length = size;
      solid.half_extents.setConstant(size);
      for (const double away : {0., 1e-170, 1e-24, 3e-23, 1e-22, 0.5}) {
        for (const Vec3d& way : {Vec3d(1, 0, 0), Vec3d(0, 0, 1), Vec3d(0, 0, -1), Vec3d(1, 1, 1)}) {
          const Pose pose{Mat3d::Identity(), away * way};
          for (const Precision scalar : scalars) {
            for (const Task task : all_tasks) {
              const Outcome o = closed_form(scalar, task, sphere(1), {}, solid, pose);
              EXPECT_EQ(o.answer, Answer::overlapping);
              if (!asks_depth(task) || o.status != Status::ok) continue;
              ++answered;
              const double precision = scalar == Precision::float32 ? 1e-5 : 1e-13;
              EXPECT_NEAR(o.distance, away * way.norm() - 1, precision);
              EXPECT_NEAR(o.normal.norm(), 1, precision) << to_string(kind) << size << away;
              EXPECT_NEAR((o.witness_b - o.witness_a - o.distance * o.normal).norm(), 0, precision);
            }
          }
        }
      }
    }
  }
  EXPECT_GT(answered, 500);
}

// On the ground, on slopes, near and far from the plane's origin, within rounding of contact.
TEST(ClosedForm, BoxOnAHalfspace) {
  Random random(4);
  oracle::Oracle oracle;
  Shape ground;
  ground.kind = ShapeKind::halfspace;
  int touching = 0, decided = 0;
  for (int k = 0; k < 2000; ++k) {
    const Shape block =
        box(uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1));
    const bool slope = k % 4 == 3;
    ground.normal = slope ? random_direction(random) : Vec3d::UnitZ();
    ground.offset = k % 3 == 0 ? uniform(random, -1, 1) : 0;
    const Pose plane{k % 2 == 0 ? Mat3d::Identity() : random_rotation(random),
                     k % 5 == 0 ? Vec3d(100 * random_direction(random)) : Vec3d::Zero()};
    Pose pose{k % 7 == 0 ? turn(uniform(random, 0, 6), Vec3d::UnitZ()) : random_rotation(random),
              10 * random_direction(random)};
    if (k % 11 == 0) pose.rotation *= 1 + uniform(random, -1e-3, 1e-3);
    const Vec3d up = (plane.rotation * ground.normal).normalized();
    const oracle::Solid a(block), b(ground);
    const double wanted = k % 6 == 0 ? uniform(random, -1, 1) : 1e-14 * uniform(random, -1, 1);
    for (int step = 0; step < 3; ++step) {
      pose.translation += (wanted - oracle.measure({a, pose}, {b, plane}).middle()) * up;
    }
    const oracle::Measure truth = oracle.measure({a, pose}, {b, plane});
    for (const Task task : all_tasks) {
      const Outcome o = closed_form(Precision::float64, task, block, pose, ground, plane);
      ASSERT_EQ(o.status, Status::ok) << k;
      ++(o.answer == Answer::touching ? touching : decided);
      if (o.answer != Answer::touching && truth.answer != Answer::touching) {
        ASSERT_EQ(o.answer, truth.answer) << k;
      }
      if (o.answer != Answer::touching && !asks_for_number(task, o.answer)) continue;
      ASSERT_LE(o.lower, truth.upper) << k;
      ASSERT_GE(o.upper, truth.lower) << k;
      ASSERT_LE(o.upper - o.lower, o.answer == Answer::touching ? 6e-14 : 2e-12) << k;
      if (task == Task::intersect) continue;
      EXPECT_NEAR(o.distance, truth.middle(), 1e-13);
      EXPECT_NEAR(o.normal.dot(up), -1, 1e-14);
      EXPECT_LE((o.witness_b - o.witness_a - o.distance * o.normal).norm(), 1e-13);
    }
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(decided, 1000);
}

TEST(ClosedForm, SaysExactlyWhatItTakes) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("closed-form");
  const auto takes = [&](ShapeKind a, ShapeKind b, Task task) { return offers(entry, a, b, task); };
  EXPECT_TRUE(takes(ShapeKind::box, ShapeKind::box, Task::penetration));
  EXPECT_TRUE(takes(ShapeKind::box, ShapeKind::box, Task::distance));
  EXPECT_FALSE(takes(ShapeKind::box, ShapeKind::cylinder, Task::distance));
  EXPECT_TRUE(takes(ShapeKind::capsule, ShapeKind::box, Task::distance));
  EXPECT_TRUE(takes(ShapeKind::sphere, ShapeKind::box, Task::distance));
  EXPECT_TRUE(takes(ShapeKind::cone, ShapeKind::halfspace, Task::distance));
  EXPECT_FALSE(takes(ShapeKind::halfspace, ShapeKind::halfspace, Task::intersect));
  EXPECT_TRUE(takes(ShapeKind::sphere, ShapeKind::cylinder, Task::penetration));
  EXPECT_TRUE(takes(ShapeKind::sphere, ShapeKind::cone, Task::distance));
  EXPECT_FALSE(takes(ShapeKind::capsule, ShapeKind::cylinder, Task::distance));
  EXPECT_FALSE(takes(ShapeKind::sphere, ShapeKind::ellipsoid, Task::intersect));
}

}  // namespace
}  // namespace touchstone::closed_form_test
