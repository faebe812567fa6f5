// Casts of bodies that touch at the start, where that counts only if they approach.
#include <gtest/gtest.h>

#include <array>

#include "algorithms/oracle/oracle.h"
#include "harness/families/grid_touches.h"
#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using namespace reference;
using families::AfterTouch;
using families::box_shape;
using families::round_shape;

std::vector<const CastEntry*> casts_of_approach() {
  std::vector<const CastEntry*> all;
  for (const CastEntry* entry : proven_casts()) {
    if (entry->approach) all.push_back(entry);
  }
  return all;
}

class ApproachingCast : public LinearCast {
 protected:
  // With the cast's own tolerance, or one.
  void expect(CastAnswer answer, const MovingPairCase& c, std::optional<double> tolerance = {}) {
    if (!takes(c)) return;
    ++asked;
    CastSettings settings;
    settings.start = StartContact::approach;
    settings.tolerance = tolerance;
    for (const MovingPairCase& form : {c, swapped(c), scaled(c, 0x1p-20), scaled(c, 0x1p20)}) {
      if (tolerance && form.what != c.what) continue;
      const CastOutcome outcome = solve(entry(), form, settings);
      EXPECT_EQ(outcome.status, Status::ok) << c.what;
      EXPECT_EQ(outcome.answer, answer) << c.what;
      if (answer == CastAnswer::hit) {
        EXPECT_EQ(outcome.toi, 0) << c.what;
      }
    }
  }
};

INSTANTIATE_TEST_SUITE_P(, ApproachingCast, testing::ValuesIn(casts_of_approach()), name_of);

// A body on the upper face of a slab, and one at its edge.
TEST_P(ApproachingCast, BodiesOnASlab) {
  const Shape tetrahedron =
      families::hull_shape({{-0.5, -0.5, -0.5}, {0.5, -0.5, -0.5}, {0, 0.5, -0.5}, {0, 0, 0.75}});
  const std::array shapes = {
      box_shape({0.5, 0.5, 0.5}), tetrahedron, round_shape(ShapeKind::cylinder, 0.5, 0.5),
      round_shape(ShapeKind::cone, 0.75, 0.5), round_shape(ShapeKind::sphere, 0.5, 0)};
  for (const Shape& shape : shapes) {
    for (const Vec3d& place : {Vec3d(3, 2, 1), Vec3d(10, -4, 1), Vec3d(10.25, 10.25, 1)}) {
      MovingPairCase c;
      c.a = box_shape({10, 10, 0.5});
      c.b = shape;
      c.pose_b.translation = place;
      // A ball beside the slab does not touch it.
      if (shape.kind == ShapeKind::sphere && place.x() > 10) continue;
      const auto with = [&](const char* what, const Vec3d& way) {
        MovingPairCase moving = c;
        moving.motion_b.displacement = way;
        moving.what = std::string(to_string(shape.kind)) + " " + what;
        return moving;
      };
      expect(CastAnswer::miss, with("rests", {0, 0, 0}));
      expect(CastAnswer::miss, with("parts", {0, 0, 1}));
      expect(CastAnswer::miss, with("parts askew", {-0.25, 0.5, 0.125}));
      expect(CastAnswer::miss, with("slides", {1, 0.5, 0}));
      expect(CastAnswer::miss, with("slides in", {-1, -0.5, 0}));
      expect(CastAnswer::hit, with("sinks", {0, 0, -0.25}));
      expect(CastAnswer::hit, with("sinks askew", {-0.5, -0.25, -0.125}));
    }
  }
  if (entry().info.name != "closed-form") {
    EXPECT_GE(asked, 10);
  }
}

// All pairs of boxes beside each other on a grid: the truth is plain.
TEST_P(ApproachingCast, BoxesInAFaceAnEdgeOrACorner) {
  const Shape box = box_shape({0.5, 0.5, 0.5});
  for (int place = 0; place < 27; ++place) {
    for (int way = 0; way < 27; ++way) {
      MovingPairCase c;
      c.a = c.b = box;
      bool parts = false, touches = false;
      for (int k = 0, at = place, go = way; k < 3; ++k, at /= 3, go /= 3) {
        c.pose_b.translation[k] = at % 3 - 1;
        c.motion_b.displacement[k] = 0.5 * (go % 3 - 1);
        if (at % 3 == 1) continue;
        touches = true;
        parts = parts || (at % 3 - 1) * (go % 3 - 1) >= 0;
      }
      if (!touches) continue;
      c.what = "boxes at " + std::to_string(place) + " towards " + std::to_string(way);
      expect(parts ? CastAnswer::miss : CastAnswer::hit, c);
    }
  }
}

// The oracle tells how deep a body gets into what the other sweeps.
TEST_P(ApproachingCast, TouchesOnAGrid) {
  constexpr double tolerance = 1e-9;
  Random random(31);
  oracle::Oracle oracle;
  for (int i = 0; i < drawn(4000, 400); ++i) {
    const MovingPairCase c = families::touching_on_grid(static_cast<AfterTouch>(i % 4), random);
    if (!takes(c)) continue;
    const auto swept =
        families::swept(c.b, c.pose_b, c.motion_b.displacement - c.motion_a.displacement);
    const oracle::Solid a(c.a), b(c.b), way(swept->shape);
    if (oracle.verdict({a, c.pose_a}, {b, c.pose_b}) != Answer::touching) continue;
    const oracle::Measure measure = oracle.measure({a, c.pose_a}, {way, swept->pose});
    const double depth = -measure.middle();
    ASSERT_TRUE(depth > 1e-3 || depth < 1e-12) << c.what << " " << i << ": " << depth;
    expect(depth > tolerance ? CastAnswer::hit : CastAnswer::miss, c, tolerance);
    ++(depth > tolerance ? counts.hits : counts.misses);
  }
  if (asked > 0) {
    EXPECT_GE(counts.hits, asked / 10);
    EXPECT_GE(counts.misses, asked / 10);
  }
}

// Turned and moved, a touch is one up to rounding.
TEST_P(ApproachingCast, TouchesInAnyFrame) {
  constexpr double tolerance = 1e-9;
  Random random(32);
  oracle::Oracle oracle;
  for (int i = 0; i < drawn(2000, 200); ++i) {
    MovingPairCase c = families::touching_on_grid(static_cast<AfterTouch>(i % 4), random);
    if (!takes(c)) continue;
    const oracle::Solid a(c.a), b(c.b);
    if (oracle.verdict({a, c.pose_a}, {b, c.pose_b}) != Answer::touching) continue;
    const Mat3d turn = random.rotation();
    const Vec3d shift = random.vector(10);
    for (Pose* pose : {&c.pose_a, &c.pose_b}) {
      pose->translation = turn * pose->translation + shift;
      pose->rotation = turn;
    }
    for (Motion* motion : {&c.motion_a, &c.motion_b}) {
      motion->displacement = turn * motion->displacement;
    }
    const auto swept =
        families::swept(c.b, c.pose_b, c.motion_b.displacement - c.motion_a.displacement);
    const oracle::Solid way(swept->shape);
    const double depth = -oracle.measure({a, c.pose_a}, {way, swept->pose}).middle();
    ASSERT_TRUE(depth > 1e-3 || depth < 1e-12) << c.what << " " << i << ": " << depth;
    CastSettings settings;
    settings.start = StartContact::approach;
    settings.tolerance = tolerance;
    const CastOutcome outcome = solve(entry(), c, settings);
    EXPECT_EQ(outcome.status, Status::ok) << c.what << " " << i;
    EXPECT_EQ(outcome.answer == CastAnswer::hit, depth > tolerance) << c.what << " " << i;
  }
}

// Bodies on a half-space, with the cast's own tolerance.
TEST_P(ApproachingCast, BodiesOnAHalfSpace) {
  Random random(33);
  for (int i = 0; i < 200; ++i) {
    const ShapeKind kind = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    MovingPairCase c;
    c.a = random_shape(kind, random);
    c.b.kind = ShapeKind::halfspace;
    c.pose_a.rotation = random.rotation();
    c.pose_b.rotation = random.rotation();
    const Vec3d up = c.pose_b.rotation.col(2);
    c.pose_a.translation = -up.dot(support_point(c.a, c.pose_a, -up)) * up;
    const Vec3d along = up.cross(random.direction());
    const std::array<Vec3d, 4> ways = {Vec3d::Zero(), along, along + 0.25 * up, along - 0.25 * up};
    for (std::size_t way = 0; way < ways.size(); ++way) {
      c.motion_a.displacement = ways[way];
      c.what = std::string(to_string(kind)) + " on a half-space, " + std::to_string(way);
      if (!takes(c)) continue;
      ++asked;
      CastSettings settings;
      const CastOutcome counted = solve(entry(), c, settings);
      settings.start = StartContact::approach;
      const CastOutcome outcome = solve(entry(), c, settings);
      EXPECT_EQ(outcome.status, Status::ok) << c.what;
      EXPECT_EQ(outcome.answer, way == 3 ? CastAnswer::hit : CastAnswer::miss) << c.what;
      // The exact one sees what rounding left between them.
      if (way < 2 && entry().info.origin != Origin::oracle) {
        EXPECT_EQ(counted.answer, CastAnswer::hit) << c.what;
      }
    }
  }
}

// Points and segments have no depth.
TEST_P(ApproachingCast, BodiesWithoutVolume) {
  MovingPairCase c;
  c.a = round_shape(ShapeKind::sphere, 0, 0);
  for (const double length : {0.0, 1.0}) {
    c.b = round_shape(ShapeKind::capsule, 0, length);
    for (const Vec3d& way : {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 0, 1), Vec3d(1, 2, -1)}) {
      c.motion_a.displacement = way;
      c.what = "a point at a segment of length " + std::to_string(length);
      expect(CastAnswer::miss, c, 1e-9);
    }
  }
}

}  // namespace
}  // namespace touchstone
