// The step in which a plane parts turning bodies, whether the plane turns or not: against poses at many times.
#include <gtest/gtest.h>

#include "algorithms/kernels/motion/advancement/parting_step.h"
#include "algorithms/kernels/motion/advancement/turning_normal.h"
#include "harness/base/reproducible_math.h"
#include "harness/families/moving_pairs.h"
#include "tests/algorithms/cast/turning_bodies.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

TEST(PartingStep, IsFreeOfContactHoweverThePlaneTurns) {
  Random random(41);
  int short_steps = 0, to_the_end = 0, of_features = 0;
  for (int i = 0; i < drawn(1500, 100); ++i) {
    const ShapeKind kind = i % 4 == 0 ? ShapeKind::hull : ShapeKind::box;
    const MovingPairCase c = families::turning(kind, ShapeKind::box, i % 3 == 0 ? 20 : 2, random);
    const Turning turning(c);
    const RelativeMotion motion = turning.motion();
    for (const double time : {0.0, 0.2, 0.4}) {
      SupportPair<double> pair = motion.at(time);
      const GjkDistanceResult<double> found = nearest(pair);
      const double gap = pair.unit() * (found.lower - pair.radius()) - 1e-9;
      if (!(gap > 0)) break;
      const Vec3d of_normal = turning_of_normal(
          found.simplex, found.direction, c.motion_a.rotation_vector, c.motion_b.rotation_vector);
      of_features += of_normal.isZero(0) ? 0 : 1;
      const Vec3d any = random.uniform(0, 4) * random.direction();
      for (const Vec3d& turn : {Vec3d(Vec3d::Zero()), of_normal, any}) {
        const FreeUntil free = longest_step(motion, pair, {time, found.direction, gap, turn});
        ++(free.to_the_end ? to_the_end : short_steps);
        for (int k = 0; k <= 16; ++k) {
          const double later = time + (free.time - time) * k / 16;
          ASSERT_GT(nearest(motion.at(later)).lower, 0)
              << c.what << " from " << time << " at " << later << " of " << free.time;
        }
      }
    }
  }
  EXPECT_GT(to_the_end, 50);
  EXPECT_GT(short_steps, 500);
  EXPECT_GT(of_features, 100);
}

// A face that turns towards a corner at its middle: the plane that turns with it serves far longer than one that keeps
// its direction and meets the face's own corners.
TEST(PartingStep, IsLongerWhereThePlaneTurnsWithItsFace) {
  MovingPairCase c;
  c.a = make_box(1, 1, 0.125);
  c.b = make_box(0.25, 0.25, 0.25);
  c.pose_b.rotation = base::rotation_between({1, 1, 1}, {0, 0, -1});
  c.pose_b.translation = {0.3, 0.1, 0.125 + 0.25 * std::sqrt(3.0) + 1e-3};
  c.motion_a.rotation_vector = {0.5, 0, 0};
  const Turning turning(c);
  const RelativeMotion motion = turning.motion();
  SupportPair<double> pair = motion.at(0);
  const GjkDistanceResult<double> found = nearest(pair);
  const Vec3d with_face =
      turning_of_normal(found.simplex, found.direction, c.motion_a.rotation_vector, Vec3d::Zero());
  EXPECT_EQ(with_face, c.motion_a.rotation_vector);
  const double gap = 1e-3 - 1e-9;
  const double fixed = longest_step(motion, pair, {0, found.direction, gap, {0, 0, 0}}).time;
  const double turned = longest_step(motion, pair, {0, found.direction, gap, with_face}).time;
  EXPECT_GT(fixed, 0);
  EXPECT_GT(turned, 5 * fixed);
}

}  // namespace
}  // namespace touchstone
