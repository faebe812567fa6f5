// `smooth` and `gjk` on many more pairs than the oracle has time for: their bounds on the same signed
// distance overlap, and most of those of `smooth` are close.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/hard_pairs.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::smooth_bounds_test {
namespace {

using namespace test;

// Thin and flat bodies among others, parallel, crosswise or coaxial up to a small angle.
Pairs aligned_pairs(Random& random, Kinds kinds, int count) {
  Pairs pairs;
  for (int k = 0; k < count; ++k) {
    const bool hard = k % 3 == 0;
    const Shape a = random_shape(random, kinds.a, hard), b = random_shape(random, kinds.b, hard);
    const Pose pose_a{random_rotation(random), random_direction(random)};
    const double angle = random() % 2 == 0 ? 0 : power(random, -15, -1);
    Mat3d rotation = random_rotation(random);
    if (k % 4 == 1) rotation = pose_a.rotation * turn(angle, random_direction(random));
    if (k % 4 == 2) {
      rotation =
          pose_a.rotation * turn(M_PI / 2 + angle, Vec3d::Unit(static_cast<int>(random() % 3)));
    }
    const Vec3d towards = random() % 5 == 0
                              ? Vec3d(pose_a.rotation.col(static_cast<int>(random() % 3)))
                              : random_direction(random);
    const double far = uniform(random, 0, 1.6) * (hard ? power(random, -3, 0) : 1);
    pairs.add(a, pose_a, b, {rotation, pose_a.translation + far * towards});
  }
  return pairs;
}

// By how much the witness points are not the distance apart along the normal.
double miss(const Outcome& o) { return (o.witness_b - o.witness_a - o.distance * o.normal).norm(); }

TEST(SmoothBounds, MeetThoseOfGjk) {
  const NarrowPhaseEntry& smooth = *registry::find<NarrowPhaseEntry>("smooth");
  const NarrowPhaseEntry& gjk = *registry::find<NarrowPhaseEntry>("gjk");
  constexpr std::array kinds{ShapeKind::sphere, ShapeKind::capsule, ShapeKind::cylinder,
                             ShapeKind::cone, ShapeKind::ellipsoid};
  Random random(41);
  int apart = 0, deep = 0, close = 0;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = std::max<std::size_t>(i, 2); j < kinds.size(); ++j) {
      const Pairs pairs = aligned_pairs(random, {kinds[i], kinds[j]}, drawn(1500, 150));
      for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
        const auto of_smooth = solve(smooth, Precision::float64, task, pairs, pairs.size());
        const auto of_gjk = solve(gjk, Precision::float64, task, pairs, pairs.size());
        for (std::size_t k = 0; k < pairs.size(); ++k) {
          const Outcome &own = of_smooth[k], &other = of_gjk[k];
          if (own.status != Status::ok || other.status != Status::ok) continue;
          SCOPED_TRACE(std::string(to_string(kinds[i])) + "-" + std::string(to_string(kinds[j])) +
                       " " + std::string(to_string(task)) + " pair " + std::to_string(k));
          ASSERT_TRUE(own.answer == other.answer || own.answer == Answer::touching ||
                      other.answer == Answer::touching);
          if (std::isnan(own.distance) || std::isnan(other.distance)) continue;
          (task == Task::distance ? apart : deep) += 1;
          close += own.upper - own.lower < 5e-12 ? 1 : 0;
          ASSERT_LE(own.lower, other.upper);
          ASSERT_GE(own.upper, other.lower);
          // Where gjk has the pair, its points are its own.
          ASSERT_TRUE(miss(own) < 3e-9 || miss(other) > 1e-9);
        }
      }
    }
  }
  EXPECT_GT(apart, drawn(3000, 100));
  EXPECT_GT(deep, drawn(5000, 100));
  EXPECT_GT(close, (apart + deep) * 4 / 5);
}

}  // namespace
}  // namespace touchstone::smooth_bounds_test
