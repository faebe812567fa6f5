// Rotations between directions, those that are nearly opposite among them.
#include "harness/base/reproducible_math.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/algorithms/random.h"

namespace touchstone::base {
namespace {

using reference::Random;

void expect_takes(const Vec3d& from, const Vec3d& to) {
  const Mat3d turn = rotation_between(from, to);
  const Vec3d a = from.normalized(), b = to.normalized();
  const double to_opposite = 1 + a.dot(b);
  const double tolerance = to_opposite < 1e-12 ? 1e-14 : 1e-14 + 4e-15 / to_opposite;
  EXPECT_LT((turn * turn.transpose() - Mat3d::Identity()).norm(), tolerance);
  EXPECT_GT(turn.determinant(), 0);
  EXPECT_LT((turn * a - b).norm(), tolerance);
  // What is across both stays: the angle is the smallest.
  const Vec3d across = a.cross(b);
  if (across.norm() > 1e-3) {
    EXPECT_LT((turn * across - across).norm(), tolerance);
  }
}

TEST(RotationBetween, TakesOneDirectionToTheOther) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d from = std::exp2(random.uniform(-20, 20)) * random.direction();
    expect_takes(from, std::exp2(random.uniform(-20, 20)) * random.direction());
    expect_takes(from, from);
  }
}

TEST(RotationBetween, TakesOpposites) {
  Random random(2);
  int small = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d from = random.direction();
    const double off = std::exp2(random.uniform(-60, -2));
    small += off < 1e-6;
    expect_takes(from, off * random.direction() - from);
    expect_takes(from, -from);
  }
  EXPECT_GT(small, 500);
  for (int axis = 0; axis < 3; ++axis) {
    expect_takes(Vec3d::Unit(axis), -Vec3d::Unit(axis));
    EXPECT_EQ(rotation_between(Vec3d::Unit(axis), Vec3d::Unit(axis)), Mat3d::Identity());
  }
}

TEST(RotationBetween, IsThatAboutAnAxisOfTheFrame) {
  const Mat3d turn = rotation_between({3, 0, 0}, {0, 5, 0});
  const Mat3d quarter{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  EXPECT_LT((turn - quarter).norm(), 1e-15);
}

}  // namespace
}  // namespace touchstone::base
