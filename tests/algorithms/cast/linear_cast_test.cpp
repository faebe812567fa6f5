// Casts of bodies that move without turning, against the truth by construction.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

INSTANTIATE_TEST_SUITE_P(, LinearCast, testing::ValuesIn(proven_casts()), name_of);

TEST_P(LinearCast, BodiesThatMeetAreHitInTime) {
  Random random(1);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const ContactFeature feature : features) {
      for (int i = 0; i < drawn(12, 4); ++i) {
        const double toi = i == 0 ? 1 : i == 1 ? 1e-9 : random.uniform(0, 1);
        const double path = std::pow(10, random.uniform(-3, 3));
        check(meeting(a, b, feature, toi, path, random), 1e-9);
      }
    }
  });
  EXPECT_LE(counts.unknown, asked / 100);
  EXPECT_GE(counts.brackets, asked / 2);
}

TEST_P(LinearCast, BodiesThatPassAreMissed) {
  Random random(2);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const double gap : {1.0, 1e-3, 1e-6, 1e-8}) {
      for (int i = 0; i < drawn(6, 1); ++i) {
        check(passing(a, b, features[static_cast<std::size_t>(i) % 3], gap,
                      std::pow(10, random.uniform(-2, 1)), random),
              1e-9);
      }
    }
  });
  EXPECT_EQ(counts.hits, 0);
  EXPECT_LE(counts.unknown, asked / 50);
}

TEST_P(LinearCast, BodiesThatGrazeAreNeverMissed) {
  Random random(3);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const double depth : {1e-6, 1e-12, 0.0}) {
      // An exact answer tells bodies that rounding has parted.
      if (depth == 0 && entry().info.origin == Origin::oracle) continue;
      for (int i = 0; i < drawn(6, 1); ++i) {
        MovingPairCase c = passing(a, b, features[static_cast<std::size_t>(i) % 3], -depth,
                                   random.uniform(0.5, 4), random);
        // Rounding of the placement may part bodies that only touch.
        if (depth == 0) {
          c.hit = false;
          c.gap = 0;
        }
        check(c, 1e-9);
      }
    }
  });
  EXPECT_GE(counts.hits, asked * 9 / 10);
}

TEST_P(LinearCast, EveryScaleAndPath) {
  Random random(4);
  for (int i = 0; i < drawn(1500, 100); ++i) {
    const ShapeKind a = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    const ShapeKind b = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    const ContactFeature feature = features[static_cast<std::size_t>(random.below(3))];
    const double scale = std::ldexp(1, random.below(41) - 20);
    const double path = std::pow(10, random.uniform(-12, 6));
    check(scaled(meeting(a, b, feature, random.uniform(0, 1), path, random), scale),
          scale * std::max(1e-9, 1e-12 * path));
    check(scaled(passing(a, b, feature, 1e-6 + 1e-8 * path, path, random), scale),
          scale * std::max(1e-9, 1e-12 * path));
  }
  EXPECT_GE(counts.hits, asked / 3);
  EXPECT_GE(counts.misses, asked / 3);
  EXPECT_LE(counts.unknown, asked / 50);
}

// The kinds with closed forms, by themselves.
TEST_P(LinearCast, BallsAndCapsules) {
  Random random(41);
  for (int i = 0; i < drawn(2000, 200); ++i) {
    const ShapeKind a = ShapeKind::sphere;
    const ShapeKind b = i % 2 == 0 ? ShapeKind::sphere : ShapeKind::capsule;
    const double scale = std::ldexp(1, random.below(41) - 20);
    const double path = std::pow(10, random.uniform(-6, 4));
    const double gap = std::pow(10, random.uniform(-7, 0)) + 1e-8 * path;
    check(
        scaled(meeting(a, b, ContactFeature::vertices, random.uniform(0, 1), path, random), scale),
        scale * 1e-9);
    check(scaled(passing(a, b, ContactFeature::face, gap, path, random), scale), scale * 1e-9);
    check(scaled(passing(a, b, ContactFeature::face, -gap, path, random), scale), scale * 1e-9);
  }
  EXPECT_GE(counts.hits, asked / 2);
  EXPECT_GE(counts.misses, asked / 4);
  EXPECT_EQ(counts.unknown, 0);
}

TEST_P(LinearCast, BodiesThatMoveAlikeOrNotAtAll) {
  Random random(5);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const double gap : {1e-6, 0.3, -1e-6, -0.2}) {
      MovingPairCase c = passing(a, b, ContactFeature::face, gap, 0, random);
      c.motion_a = c.motion_b = {};
      c.toi = 0;
      check(c, 1e-9);
      check(drifting(c, random.vector(10)), 1e-9);
    }
  });
  EXPECT_GE(counts.hits, asked * 2 / 5);
  EXPECT_GE(counts.misses, asked * 2 / 5);
}

TEST_P(LinearCast, ThinPlatesStopBullets) {
  Random random(6);
  const Shape plate = make_box(1, 1, 1e-4);
  for (int i = 0; i < drawn(200, 20); ++i) {
    MovingPairCase c;
    c.what = "a bullet through a plate";
    c.a = plate;
    c.b = i % 2 == 0 ? make_sphere(0.01) : make_box(0.01, 0.01, 0.01);
    c.pose_b.translation = {random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), 1};
    c.motion_b.displacement = {0, 0, random.uniform(-40, -2)};
    c.hit = true;
    c.speed = -c.motion_b.displacement.z();
    c.toi = (1 - 0.01 - 1e-4) / c.speed;
    c.doubt = 1e-13;
    check(c, 1e-9);
  }
  EXPECT_EQ(counts.hits, asked);
}

TEST_P(LinearCast, HalfSpaces) {
  Random random(7);
  for (const ShapeKind kind : bounded_kinds) {
    for (int i = 0; i < drawn(60, 5); ++i) {
      MovingPairCase c;
      c.what = "a half-space and a " + std::string(to_string(kind));
      c.a = random_shape(kind, random);
      c.pose_a = {random.rotation(), random.vector(2)};
      const Vec3d normal = random.direction();
      c.b = make_halfspace(3 * normal, 3 * random.uniform(-1, 1));
      const Vec3d low = support_point(c.a, c.pose_a, -normal);
      const double gap = random.uniform(0.01, 1);
      c.pose_b.translation = (normal.dot(low) - c.b.offset / 3 - gap) * normal;
      const double speed =
          i % 2 == 0 ? random.uniform(1.01, 9) * gap : random.uniform(-3, 0.99) * gap;
      c.motion_a.displacement = -speed * normal + normal.cross(random.vector(5));
      c.hit = speed > gap;
      c.speed = speed;
      c.toi = gap / speed;
      c.gap = gap - std::max(speed, 0.0);
      c.doubt = 1e-13 / gap;
      check(c, 1e-9);
    }
  }
  if (asked > 0) {
    EXPECT_GT(counts.hits, asked / 3);
    EXPECT_GT(counts.misses, asked / 3);
  }
}

}  // namespace
}  // namespace touchstone
