#include "harness/base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone {
namespace {

TEST(PortableMath, SineAndCosineAreRight) {
  base::Random random(1);
  for (int i = 0; i < 100'000; ++i) {
    const double turns = random.uniform(-3, 3);
    const long double angle =
        2 * std::numbers::pi_v<long double> * (static_cast<long double>(turns) - std::floor(turns));
    EXPECT_NEAR(base::sin_cos_turns(turns).sin, static_cast<double>(std::sin(angle)), 1e-15);
    EXPECT_NEAR(base::sin_cos_turns(turns).cos, static_cast<double>(std::cos(angle)), 1e-15);
  }
  const double quarters[][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
  for (int quarter = -8; quarter < 8; ++quarter) {
    const base::SinCos turn = base::sin_cos_turns(0.25 * quarter);
    EXPECT_EQ(turn.sin, quarters[(quarter + 8) % 4][0]);
    EXPECT_EQ(turn.cos, quarters[(quarter + 8) % 4][1]);
  }
}

TEST(PortableMath, CubeRootsAreRight) {
  base::Random random(2);
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.magnitude(1e-300, 1e300);
    EXPECT_NEAR(base::cube_root(x) / std::cbrt(x), 1, 1e-15);
  }
}

TEST(Random, NormalNumbersAreNormal) {
  base::Random random(7);
  constexpr int count = 1'000'000;
  double sum = 0, squares = 0, fourths = 0;
  int beyond[4] = {};  // 0.5, 1, 2, 3 deviations
  const double limits[4] = {0.5, 1, 2, 3};
  for (int i = 0; i < count; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    for (int k = 0; k < 4; ++k) beyond[k] += x > limits[k];
  }
  // Six deviations of each estimate.
  EXPECT_NEAR(sum / count, 0, 6e-3);
  EXPECT_NEAR(squares / count, 1, 6 * std::sqrt(2.0 / count));
  EXPECT_NEAR(fourths / count, 3, 6 * std::sqrt(96.0 / count));
  for (int k = 0; k < 4; ++k) {
    const double p = std::erfc(limits[k] / std::sqrt(2.0)) / 2;
    EXPECT_NEAR(static_cast<double>(beyond[k]) / count, p, 6 * std::sqrt(p * (1 - p) / count));
  }
}

TEST(Random, IsWhatItWas) {
  base::Random random(42);
  EXPECT_EQ(random.next(), 11206042627743653740u);
  EXPECT_NE(base::Random(42, 1).next(), base::Random(42, 0).next());
  EXPECT_NE(base::Random(42, 1).next(), base::Random(1, 42).next());
}

TEST(Random, BelowIsEven) {
  base::Random random(3);
  int seen[7] = {};
  for (int i = 0; i < 70'000; ++i) ++seen[random.below(7)];
  for (const int count : seen) EXPECT_NEAR(count, 10'000, 500);
}

TEST(Random, MagnitudesAreEvenAndInside) {
  base::Random random(4);
  int seen[4] = {};
  for (int i = 0; i < 40'000; ++i) {
    const double x = random.magnitude(1, 10'000);
    ASSERT_GE(x, 1);
    ASSERT_LE(x, 10'000);
    ++seen[static_cast<int>(std::min(3.0, std::floor(std::log10(x))))];
  }
  for (const int count : seen) EXPECT_NEAR(count, 10'000, 1000);
  EXPECT_EQ(random.magnitude(3, 3), 3);
}

TEST(Random, RotationsAreOrthonormalAndEven) {
  base::Random random(5);
  Vec3d sum = Vec3d::Zero();
  for (int i = 0; i < 20'000; ++i) {
    const Mat3d r = random.rotation();
    ASSERT_LT((r.transpose() * r - Mat3d::Identity()).norm(), 4e-15);
    ASSERT_GT(r.determinant(), 0);
    sum += r.col(0);
  }
  EXPECT_LT(sum.norm() / 20'000, 0.02);
}

TEST(Random, BallAndSphere) {
  base::Random random(6);
  int inner = 0;
  for (int i = 0; i < 16'000; ++i) {
    const double radius = random.in_ball().norm();
    ASSERT_LE(radius, 1);
    inner += radius <= 0.5;
    ASSERT_NEAR(random.on_sphere().norm(), 1, 1e-15);
  }
  EXPECT_NEAR(inner, 2000, 200);
}

}  // namespace
}  // namespace touchstone
