// The closed forms at the places where a formula breaks: cores that meet, centres that coincide,
// gaps down to rounding.
#include <gtest/gtest.h>

#include <cmath>

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
  EXPECT_FALSE(takes(ShapeKind::sphere, ShapeKind::ellipsoid, Task::intersect));
}

}  // namespace
}  // namespace touchstone::closed_form_test
