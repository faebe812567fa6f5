// The planes that are chosen because they last: that they part the bodies, what the points of boxes are, and that steps
// along them are longer than along the planes of the closest points.
#include <gtest/gtest.h>

#include "algorithms/kernels/gjk/separation_along.h"
#include "algorithms/kernels/motion/advancement/box_planes.h"
#include "algorithms/kernels/motion/advancement/parting_step.h"
#include "algorithms/kernels/motion/advancement/round_planes.h"
#include "harness/families/moving_pairs.h"
#include "tests/algorithms/cast/turning_bodies.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

PairMotion motion_of(const MovingPairCase& c) {
  return {c.motion_b.displacement - c.motion_a.displacement, c.motion_a.rotation_vector,
          c.motion_b.rotation_vector};
}

double step_along(const RelativeMotion& motion, SupportPair<double>& pair, double time,
                  const Vec3d& normal, const Vec3d& turning) {
  const double gap = pair.unit() * (separation_along(pair, normal) - pair.radius());
  return longest_step(motion, pair, {time, normal, gap, turning}).time - time;
}

// Returns true if the point, from the box's centre, is in it.
bool is_in_box(const PosedShape<double>& box, double unit, const Vec3d& point) {
  const double size = box.shape().unit / unit;
  const Vec3d seen = box.matrix().transpose() * point / size;
  return ((seen.cwiseAbs() - size * box.shape().extents).array() < 1e-12).all();
}

TEST(LastingPlanes, OfBoxesPartThemOrTellTheirPoints) {
  Random random(52);
  int open = 0, near = 0, exact = 0, overlap = 0, longer = 0, shorter = 0;
  for (int i = 0; i < 4000; ++i) {
    const MovingPairCase c = families::turning(ShapeKind::box, ShapeKind::box, i % 3, random);
    const Turning turning(c);
    const RelativeMotion motion = turning.motion();
    const double time = random.uniform(0, 1);
    SupportPair<double> pair = motion.at(time);
    const GjkDistanceResult<double> closest = nearest(pair);
    const bool meet = closest.end == GjkDistanceResult<double>::End::contact;
    // A gap of every tenth pair is that of the closest points, or a little more: no axis is open then.
    const bool is_tight = i % 10 == 0 && !meet;
    const double least = is_tight ? closest.upper * random.uniform(1, 1.5) : 1e-4;
    const BoxLook found = look_at_boxes(pair, motion_of(c), least);
    switch (found.state) {
      case BoxLook::State::open: {
        ++open;
        ASSERT_FALSE(meet) << i;
        ASSERT_NEAR(found.normal.norm(), 1, 1e-14);
        ASSERT_GT(separation_along(pair, found.normal), least - 1e-13) << i;
        // The plane of the closest points serves for a short time alone, where the bodies are about to meet.
        const double of_closest = step_along(motion, pair, time, closest.direction, Vec3d::Zero());
        if (pair.unit() * closest.upper > 0.1 || of_closest > 0.1) break;
        const double along = step_along(motion, pair, time, found.normal, found.turning);
        ++(along > of_closest ? longer : shorter);
        break;
      }
      case BoxLook::State::near: {
        ++near;
        ASSERT_NEAR(found.normal.norm(), 1, 1e-14);
        ASSERT_TRUE(is_in_box(pair.a(), pair.unit(), found.on_a)) << i;
        ASSERT_TRUE(is_in_box(pair.b(), pair.unit(), found.on_b)) << i;
        const double distance = (pair.centre_b() + found.on_b - found.on_a).norm();
        ASSERT_GT(distance, closest.lower - 1e-12) << i;
        exact += distance < closest.upper + 1e-9 ? 1 : 0;
        break;
      }
      case BoxLook::State::overlap: ++overlap; ASSERT_TRUE(meet) << i;
    }
  }
  EXPECT_GT(open, 100);
  EXPECT_GT(overlap, 10);
  EXPECT_GT(near, 10);
  EXPECT_GT(exact, near / 3);
  EXPECT_GT(longer, 2 * shorter);
}

TEST(LastingPlanes, OfBoxesAreEqualAtEveryLevel) {
  Random random(54);
  for (int i = 0; i < drawn(500, 100); ++i) {
    const MovingPairCase c = families::turning(ShapeKind::box, ShapeKind::box, i % 3, random);
    const Turning turning(c);
    SupportPair<double> pair = turning.motion().at(random.uniform(0, 1));
    std::vector<BoxLook> looks;
    for (const Isa level : isa_levels()) {
      limit_isa(level);
      looks.push_back(look_at_boxes(pair, motion_of(c), 0.1));
    }
    limit_isa(isa_of_machine());
    for (const BoxLook& look : looks) {
      EXPECT_EQ(look.state, looks[0].state);
      EXPECT_EQ(look.normal, looks[0].normal);
      EXPECT_EQ(look.turning, looks[0].turning);
      EXPECT_EQ(look.on_a, looks[0].on_a);
      EXPECT_EQ(look.on_b, looks[0].on_b);
    }
  }
}

TEST(LastingPlanes, OfBoxesThatAreNotNumbersTellNothing) {
  MovingPairCase c;
  c.a = c.b = make_box(1, 1, 1);
  c.pose_b.translation.setConstant(std::numeric_limits<double>::quiet_NaN());
  const Turning turning(c);
  SupportPair<double> pair = turning.motion().at(0);
  EXPECT_EQ(look_at_boxes(pair, motion_of(c), 1e-4).state, BoxLook::State::overlap);
}

TEST(LastingPlanes, OfRoundBodiesPartThemForLonger) {
  Random random(53);
  int apart = 0, meet = 0;
  double along = 0, of_closest = 0;
  for (int i = 0; i < 4000; ++i) {
    const ShapeKind kind = i % 4 == 0 ? ShapeKind::sphere : ShapeKind::capsule;
    const MovingPairCase c = families::turning(kind, ShapeKind::capsule, i % 3, random);
    const Turning turning(c);
    const RelativeMotion motion = turning.motion();
    const double time = random.uniform(0, 1), least = 1e-6;
    SupportPair<double> pair = motion.at(time);
    const ClosestOfRound now = closest_of_round(pair);
    if (!(now.between.norm() - pair.radius() > least)) {
      ++meet;
      continue;
    }
    ++apart;
    const Vec3d normal = lasting_normal(pair, motion_of(c), now, 1 - time, least);
    ASSERT_NEAR(normal.norm(), 1, 1e-14);
    ASSERT_GT(separation_along(pair, normal) - pair.radius(), least - 1e-13) << i;
    along += step_along(motion, pair, time, normal, Vec3d::Zero());
    of_closest += step_along(motion, pair, time, now.between.normalized(), Vec3d::Zero());
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(meet, 10);
  EXPECT_GT(along, 1.05 * of_closest);
}

}  // namespace
}  // namespace touchstone
