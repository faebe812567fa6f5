// Tests the exact problems of all encodings, and that entries state the right one.
#include "harness/grade/true_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "harness/base/random.h"
#include "harness/process/solve_case.h"
#include "tests/harness/check/pairs.h"

namespace touchstone {
namespace {

double as_float(double x) { return static_cast<double>(static_cast<float>(x)); }

files::Case turned_pair() {
  base::Random random(5);
  files::Case c = along_x(cube(0.1), ball(0.3), 0.7);
  c.pose_a.rotation = random.rotation();
  c.pose_a.translation = {100.1, 200.2, 300.3};
  c.pose_b.rotation = random.rotation();
  c.pose_b.translation = c.pose_a.translation + Vec3d(1.1, 0, 0);
  return c;
}

TEST(Encoding, AsGivenIsTheCaseItself) {
  const files::Case c = turned_pair();
  const grade::EncodedPair pair(c, Encoding::as_given);
  EXPECT_EQ(pair.a().matrix, c.pose_a.rotation);
  EXPECT_EQ(pair.b().translation, c.pose_b.translation);
  EXPECT_EQ(pair.b().solid->radius, 0.3);
  EXPECT_FALSE(pair.a().quaternion);
  EXPECT_TRUE(pair.is_finite());
}

TEST(Encoding, FloatsAreRoundedOneByOne) {
  const files::Case c = turned_pair();
  const grade::EncodedPair pair(c, Encoding::float32);
  EXPECT_EQ(pair.a().translation.x(), as_float(100.1));
  EXPECT_EQ(pair.a().matrix(1, 2), as_float(c.pose_a.rotation(1, 2)));
  EXPECT_EQ(pair.a().solid->vertices[7].x(), as_float(0.1));
  EXPECT_EQ(pair.b().solid->radius, as_float(0.3));
  EXPECT_FALSE(pair.b().quaternion);
}

TEST(Encoding, RelativeFloatsAreAboutTheFirstBody) {
  files::Case c = turned_pair();
  auto hull = std::make_shared<Hull>();
  hull->vertices = {{10, 0, 0}, {11, 0, 0}, {10, 1, 0}, {10.1, 0.2, 0.7}};
  c.shape_b = Shape();
  c.shape_b.kind = ShapeKind::hull;
  c.shape_b.hull = hull;
  const grade::EncodedPair pair(c, Encoding::float32_relative);
  EXPECT_EQ(pair.a().translation, Vec3d::Zero());
  const Vec3d centre = encoding_centre(c.shape_b);
  EXPECT_NEAR(centre.x(), 10.275, 1e-12);
  const Vec3d offset = c.pose_b(centre) - c.pose_a.translation;
  EXPECT_EQ(pair.b().translation.y(), as_float(offset.y()));
  EXPECT_EQ(pair.b().solid->vertices[3].x(), as_float(10.1 - centre.x()));
  // The pair is the same up to the rounding of small numbers, although it is far away.
  oracle::Oracle oracle;
  const grade::EncodedPair exact(c, Encoding::as_given);
  EXPECT_NEAR(oracle.measure(pair.a(), pair.b()).middle(),
              oracle.measure(exact.a(), exact.b()).middle(), 1e-5);
}

TEST(Encoding, QuaternionsStandForTheSameRotation) {
  const files::Case c = turned_pair();
  oracle::Oracle oracle;
  const grade::EncodedPair exact(c, Encoding::as_given);
  const double distance = oracle.measure(exact.a(), exact.b()).middle();
  for (const Encoding encoding : {Encoding::quaternion, Encoding::quaternion_float32}) {
    const bool single = encoding == Encoding::quaternion_float32;
    const grade::EncodedPair pair(c, encoding);
    ASSERT_TRUE(pair.a().quaternion && pair.b().quaternion);
    for (const double part : *pair.a().quaternion) {
      if (single) {
        EXPECT_EQ(part, as_float(part));
      }
    }
    EXPECT_EQ(pair.a().translation.x(), single ? as_float(100.1) : 100.1);
    EXPECT_NEAR(oracle.measure(pair.a(), pair.b()).middle(), distance, single ? 1e-4 : 1e-13);
  }
}

TEST(Encoding, HalfspacesAreMadeUnitBeforeTheyAreRounded) {
  files::Case c = turned_pair();
  c.shape_b = Shape();
  c.shape_b.kind = ShapeKind::halfspace;
  c.shape_b.normal = {3, 0, 4};
  c.shape_b.offset = 1;
  const grade::EncodedPair pair(c, Encoding::float32);
  EXPECT_EQ(pair.b().solid->normal, Vec3d(as_float(0.6), 0, as_float(0.8)));
  EXPECT_EQ(pair.b().solid->offset, as_float(0.2));
}

TEST(Encoding, BeyondTheRangeOfFloatsThereIsNoPair) {
  const files::Case c = along_x(cube(1), cube(1), 1e39);
  EXPECT_TRUE(grade::EncodedPair(c, Encoding::as_given).is_finite());
  EXPECT_TRUE(grade::EncodedPair(c, Encoding::quaternion).is_finite());
  EXPECT_FALSE(grade::EncodedPair(c, Encoding::float32).is_finite());
  EXPECT_FALSE(grade::EncodedPair(c, Encoding::float32_relative).is_finite());
}

TEST(Encoding, RelativeKeepsDoubles) {
  files::Case c = turned_pair();
  auto hull = std::make_shared<Hull>();
  hull->vertices = {{10, 0, 0}, {11, 0, 0}, {10, 1, 0}, {10.1, 0.2, 0.7}};
  c.shape_b = Shape();
  c.shape_b.kind = ShapeKind::hull;
  c.shape_b.hull = hull;
  const grade::EncodedPair pair(c, Encoding::relative);
  const Vec3d centre = encoding_centre(c.shape_b);
  EXPECT_EQ(pair.a().translation, Vec3d::Zero());
  EXPECT_EQ(pair.a().matrix, c.pose_a.rotation);
  EXPECT_EQ(pair.b().translation, c.pose_b(centre) - c.pose_a.translation);
  EXPECT_EQ(pair.b().solid->vertices[3], hull->vertices[3] - centre);
  oracle::Oracle oracle;
  const grade::EncodedPair exact(c, Encoding::as_given);
  EXPECT_NEAR(oracle.measure(pair.a(), pair.b()).middle(),
              oracle.measure(exact.a(), exact.b()).middle(), 1e-12);
}

// Each library's answer is near the exact one for the encoding that its entry states, even if the
// conversion moves the bodies by much more.
TEST(Encoding, WhatTheEntriesSayIsWhatTheLibrariesGet) {
  oracle::Oracle oracle;
  base::Random random(11);
  int compared = 0;
  int moved = 0;  // pairs that the conversion changes more than the library errs
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (!is_built(entry.info) || !offers(entry, Task::distance)) continue;
    for (const Precision scalar : entry.scalars) {
      for (int i = 0; i < 20; ++i) {
        // Balls are exact in every library, so that only the conversion shows.
        files::Case c = along_x(ball(0.3), ball(0.4), 0);
        c.pose_a.rotation = random.rotation();
        c.pose_b.rotation = random.rotation();
        c.pose_a.translation = 1e5 * random.in_ball();
        c.pose_b.translation = c.pose_a.translation + 2 * random.on_sphere();
        if (!offers(entry, c.shape_a.kind, c.shape_b.kind, Task::distance)) continue;
        const Encoding encoding =
            encoding_of(entry, c.shape_a.kind, c.shape_b.kind, Task::distance, scalar);
        const grade::EncodedPair given(c, encoding), exact(c, Encoding::as_given);
        const double expected = oracle.measure(given.a(), given.b()).middle();
        const double end = oracle.measure(exact.a(), exact.b()).middle();
        const Outcome o = process::solve_case(entry, {.scalar = scalar}, c, Task::distance);
        ASSERT_EQ(o.answer, Answer::separated) << entry.info.name;
        EXPECT_NEAR(o.distance, expected, 2e-5) << entry.info.name << to_string(encoding);
        moved += std::abs(expected - end) > 1e-3 ? 1 : 0;
        ++compared;
      }
    }
  }
  if (registry::find<NarrowPhaseEntry>("fcl-libccd")->make != nullptr) {
    EXPECT_GE(moved, 10);
  }
  EXPECT_GE(compared, 40);
}

}  // namespace
}  // namespace touchstone
