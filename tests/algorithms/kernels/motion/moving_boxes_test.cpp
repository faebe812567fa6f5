// Tests of moving boxes against rational arithmetic: random ones, ones that touch for an instant, ones
// that move alike, and extreme ones.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/core/bounds.h"
#include "algorithms/kernels/motion/moving_boxes.h"
#include "algorithms/kernels/motion/relative_motion.h"
#include "algorithms/kernels/motion/swept_box.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using Rational = boost::multiprecision::cpp_rational;

// Narrows the times to those with speed * t <= gap. Returns false if there are none.
bool narrow(const Rational& speed, const Rational& gap, Rational& first, Rational& last) {
  if (speed == 0) return gap >= 0;
  const Rational at = gap / speed;
  if (speed > 0 && at < last) last = at;
  if (speed < 0 && at > first) first = at;
  return first <= last;
}

bool meet_exactly(const MovingBox& a, const MovingBox& b) {
  if (a.box.is_empty() || b.box.is_empty()) return false;
  Rational first = 0, last = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational speed = Rational(a.displacement[k]) - Rational(b.displacement[k]);
    if (!narrow(speed, Rational(b.box.max[k]) - Rational(a.box.min[k]), first, last)) return false;
    if (!narrow(-speed, Rational(a.box.max[k]) - Rational(b.box.min[k]), first, last)) return false;
  }
  return true;
}

struct Level {
  explicit Level(Isa isa) { limit_isa(isa); }
  ~Level() { limit_isa(isa_of_machine()); }
};

// Compares all pairs at every level of vector instructions, and returns how many meet.
std::size_t expect_exact(const std::vector<MovingBox>& bodies) {
  std::vector<IndexPair> pairs, meeting;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
      pairs.push_back({i, j});
      if (meet_exactly(bodies[i], bodies[j])) meeting.push_back({i, j});
      EXPECT_EQ(moving_boxes_meet(bodies[i], bodies[j]), meet_exactly(bodies[i], bodies[j]));
    }
  }
  for (const Isa isa : isa_levels()) {
    const Level level(isa);
    PairBuffer kept;
    keep_meeting(bodies, pairs, kept);
    EXPECT_EQ(std::vector(kept.pairs().begin(), kept.pairs().end()), meeting);
  }
  return meeting.size();
}

MovingBox make_box(const std::array<float, 3>& min, const std::array<float, 3>& max,
                   const std::array<float, 3>& displacement) {
  return {{min, max}, displacement, 0};
}

// Numbers on a coarse grid touch often; a scale makes them great or small.
std::vector<MovingBox> grid_boxes(reference::Random& random, std::size_t count, float scale,
                                  bool moves_evenly) {
  std::vector<MovingBox> bodies(count);
  for (MovingBox& body : bodies) {
    for (std::size_t k = 0; k < 3; ++k) {
      body.box.min[k] = static_cast<float>(random.below(24)) * scale;
      body.box.max[k] = body.box.min[k] + static_cast<float>(random.below(4)) * scale;
      const int step = moves_evenly && random.below(2) == 0 ? 5 : random.below(31) - 15;
      body.displacement[k] = static_cast<float>(step) * scale;
    }
  }
  return bodies;
}

TEST(MovingBoxes, OnAGridAreDecidedExactly) {
  reference::Random random(1);
  for (const float scale : {1.0F, 0.1F, 0x1p-149F, 0x1p-130F, 1e-30F, 1e30F, 0x1p122F}) {
    for (const bool moves_evenly : {false, true}) {
      const std::size_t count = 64;
      const std::size_t meeting = expect_exact(grid_boxes(random, count, scale, moves_evenly));
      EXPECT_GT(meeting, 4U) << scale;
      EXPECT_LT(meeting, count * (count - 1) / 4) << scale;
    }
  }
}

TEST(MovingBoxes, OfAnyMagnitudeAreDecidedExactly) {
  reference::Random random(2);
  std::size_t meeting = 0, all = 0;
  for (int round = 0; round < drawn(20, 3); ++round) {
    std::vector<MovingBox> bodies(40);
    for (MovingBox& body : bodies) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto number = [&] {
          return static_cast<float>(std::ldexp(random.uniform(-1, 1), random.below(8) - 4));
        };
        const float one = number(), other = number();
        body.box.min[k] = std::min(one, other);
        body.box.max[k] = std::max(one, other);
        body.displacement[k] = static_cast<float>(std::ldexp(number(), random.below(12)));
      }
    }
    meeting += expect_exact(bodies);
    all += 40 * 39 / 2;
  }
  EXPECT_GT(meeting, all / 50);
  EXPECT_LT(meeting, all / 2);
}

// A corner passes a corner at one instant, which rounding hides; then by one unit in the last place.
TEST(MovingBoxes, ThatTouchForAnInstantMeet) {
  reference::Random random(3);
  std::vector<MovingBox> bodies;
  int met = 0, missed = 0;
  for (int round = 0; round < drawn(3000, 300); ++round) {
    // The first box comes from below on x and leaves from above on y at the time p / q.
    const auto q = static_cast<float>(1 + random.below(4000)), p = std::floor(q / 2) + 1;
    const float fast = static_cast<float>(1 + random.below(500)) * q;
    const float slow = static_cast<float>(1 + random.below(500)) * q;
    const MovingBox rest = make_box({0, 0, 0}, {1, 1, 1}, {0, 0, 0});
    const float x = -fast / q * p, y = 1 + slow / q * p;
    MovingBox other =
        make_box({x - 1, y - 1 - slow / q * p, 0}, {x, 1 + 0 * y, 1}, {fast, slow, 0});
    other.box.min[1] = 1 - slow / q * p;  // it leaves upwards past y = 1 at that time
    other.box.max[1] = other.box.min[1] + 1;
    ASSERT_EQ(moving_boxes_meet(rest, other), meet_exactly(rest, other));
    MovingBox nudged = other;
    const int axis = random.below(2);
    nudged.box.min[axis] = std::nextafter(nudged.box.min[axis], INFINITY);
    nudged.box.max[axis] = std::nextafter(nudged.box.max[axis], axis == 0 ? -INFINITY : INFINITY);
    ASSERT_EQ(moving_boxes_meet(rest, nudged), meet_exactly(rest, nudged));
    met += meet_exactly(rest, other);
    missed += !meet_exactly(rest, nudged);
    bodies = {rest, other, rest, nudged};
    if (round % 10 == 0) expect_exact(bodies);
  }
  EXPECT_GT(met, drawn(3000, 300) / 2);
  EXPECT_GT(missed, drawn(3000, 300) / 2);
}

TEST(MovingBoxes, ThatAreEmptyMeetNothing) {
  const MovingBox empty = {Aabb::empty(), {0, 0, 0}, 0};
  const MovingBox body = make_box({-1, -1, -1}, {1, 1, 1}, {3, 0, 0});
  EXPECT_FALSE(moving_boxes_meet(empty, body));
  EXPECT_FALSE(moving_boxes_meet(body, empty));
}

TEST(MovingBoxes, WithInfiniteEnds) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const MovingBox below =
      make_box({-infinite, -infinite, -infinite}, {infinite, infinite, 0}, {0, 0, 1});
  EXPECT_TRUE(moving_boxes_meet(below, make_box({0, 0, 1}, {1, 1, 2}, {0, 0, 0})));
  EXPECT_FALSE(moving_boxes_meet(below, make_box({0, 0, 1.001F}, {1, 1, 2}, {0, 0, 0})));
  EXPECT_TRUE(moving_boxes_meet(below, make_box({0, 0, 5}, {1, 1, 6}, {0, 0, -4})));
}

TEST(SweptBoxes, ContainTheBoxAtEveryTime) {
  reference::Random random(4);
  for (int round = 0; round < drawn(2000, 200); ++round) {
    const float scale = std::ldexp(1.0F, random.below(240) - 120);
    const MovingBox body = grid_boxes(random, 1, scale * 0.7F, false)[0];
    const int parts = 1 << random.below(7), part = random.below(parts);
    const double begin = static_cast<double>(part) / parts;
    const double end = static_cast<double>(part + 1) / parts;
    const Aabb box = swept_box_of(body, begin, end);
    const auto next_down = [](float x) { return std::nextafter(x, -INFINITY); };
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational move(body.displacement[k]), t = move >= 0 ? begin : end;
      const Rational low = Rational(body.box.min[k]) + t * move;
      const Rational high = Rational(body.box.max[k]) + Rational(move >= 0 ? end : begin) * move;
      EXPECT_LE(Rational(box.min[k]), low);
      EXPECT_GE(Rational(box.max[k]), high);
      // Nothing is lost: the next floats inward are inside.
      EXPECT_GT(-Rational(next_down(-box.min[k])), low);
      EXPECT_LT(Rational(next_down(box.max[k])), high);
    }
  }
}

TEST(SweptBoxes, BeyondTheRangeOfFloatsAreCutAndStillOverlap) {
  constexpr float greatest = std::numeric_limits<float>::max();
  const MovingBox far = make_box({1e38F, 0, 0}, {2e38F, 1, 1}, {greatest, 0, 0});
  const Aabb box = swept_box_of(far, 0, 1);
  EXPECT_EQ(box.max[0], greatest);
  const MovingBox other = make_box({-greatest, 0, 0}, {-3e38F, 1, 1}, {-greatest, 0, 0});
  EXPECT_FALSE(overlap(box, swept_box_of(other, 0, 1)));
  EXPECT_TRUE(swept_box_of({Aabb::empty(), {1, 0, 0}, 0}, 0, 1).is_empty());
}

// Support of a shape by brute force: its extent along the axes at a time, from points on it.
TEST(MovingBoxOf, HoldsTheBodyAtEveryTime) {
  reference::Random random(5);
  double tightness = 0;
  const int rounds = drawn(400, 60);
  for (int round = 0; round < rounds; ++round) {
    const double size = std::ldexp(1.0, random.below(40) - 20);
    const Shape shapes[] = {reference::make_sphere(size),
                            reference::make_capsule(size / 4, size),
                            reference::make_box(size, size / 7, size / 3),
                            reference::make_cone(size, size),
                            reference::make_cylinder(size, size),
                            reference::make_ellipsoid(size, size / 2, size / 9)};
    const Shape& shape = shapes[random.below(6)];
    const Pose pose = {random.rotation(), random.vector(10 * size)};
    const double angle = std::ldexp(random.uniform(0, 1), random.below(8) - 3);
    const Motion motion = {random.vector(20 * size), angle * random.direction()};
    const MovingBox body = moving_box_of(shape, pose, motion);
    for (int k = 0; k <= 32; ++k) {
      const double t = k / 32.0;
      const Pose at = {rotation_by(t * motion.rotation_vector) * pose.rotation,
                       pose.translation + t * motion.displacement};
      const Aabb tight = tight_box(shape, at), held = swept_box_of(body, t, t);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // The tight box is itself rounded outward to floats.
        const float low = std::nextafter(std::nextafter(tight.min[axis], INFINITY), INFINITY);
        const float high = std::nextafter(std::nextafter(tight.max[axis], -INFINITY), -INFINITY);
        EXPECT_LE(held.min[axis], low) << angle;
        EXPECT_GE(held.max[axis], high) << angle;
      }
    }
    const Aabb loose = loose_box(loose_reach(shape, pose.rotation), pose.translation);
    tightness += (body.box.max[0] - body.box.min[0]) / (loose.max[0] - loose.min[0]);
  }
  EXPECT_LT(tightness, 0.97 * rounds);
}

TEST(MovingBoxOf, ABodyWithoutMotionIsItsTightBox) {
  const Shape shape = reference::make_box(1, 2, 3);
  const Pose pose = {Mat3d::Identity(), {0.1, 0.2, 0.3}};
  const MovingBox body = moving_box_of(shape, pose, {});
  EXPECT_EQ(body.box, tight_box(shape, pose));
  EXPECT_EQ(swept_box_of(body, 0, 1), body.box);
}

TEST(MovingBoxOf, HalfSpaces) {
  const Shape ground = reference::make_halfspace({0, 0, 1}, 0);
  const MovingBox lifted = moving_box_of(ground, {}, {{0, 0, 2}, {0, 0, 0}});
  EXPECT_EQ(lifted.box.max[2], 0);
  EXPECT_EQ(swept_box_of(lifted, 0, 1).max[2], 2);
  const MovingBox turned = moving_box_of(ground, {}, {{0, 0, 0}, {1, 0, 0}});
  EXPECT_TRUE(std::isinf(turned.box.max[2]));
}

}  // namespace
}  // namespace touchstone
