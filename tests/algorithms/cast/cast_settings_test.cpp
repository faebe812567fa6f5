// The settings of casts are kept, also where they ask for more than rounding lets be told.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

using CastSettingsTest = LinearCast;
INSTANTIATE_TEST_SUITE_P(, CastSettingsTest, testing::ValuesIn(proven_casts()), name_of);

// No double is that near to contact.
TEST_P(CastSettingsTest, AHitIsProvenWhereRoundingHidesMoreThanTheTolerance) {
  Random random(1);
  CastSettings settings;
  settings.tolerance = 1e-300;
  int unknown = 0, hits = 0;
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (int i = 0; i < drawn(30, 4); ++i) {
      const ContactFeature feature = features[static_cast<std::size_t>(i) % 3];
      const bool meets = i % 2 == 0;
      const MovingPairCase c =
          meets ? meeting(a, b, feature, 0.5, 2, random) : passing(a, b, feature, 0, 2, random);
      if (!takes(c)) continue;
      ++asked;
      const CastOutcome outcome = solve(entry(), c, settings);
      if (outcome.answer == CastAnswer::unknown) {
        EXPECT_EQ(outcome.status, Status::not_converged) << c.what;
        EXPECT_GE(outcome.lower, 0) << c.what;
        ++unknown;
      }
      if (outcome.answer != CastAnswer::hit) continue;
      EXPECT_FALSE(std::isnan(outcome.upper)) << c.what;
      ++hits;
    }
  });
  EXPECT_GE(hits, asked / 4);
  const bool is_ours = entry().info.origin == Origin::ours;
  EXPECT_GE(unknown, is_ours ? asked / 20 : 0);
}

// The bodies are apart by a thousandth and more, and part further, so far that rounding at the end is greater.
TEST_P(CastSettingsTest, BodiesThatPartByFarAreNoHit) {
  CastSettings settings;
  settings.tolerance = 1e-6;
  const Shape box = make_box(1, 1, 1);
  int answered = 0;
  for (const double far : {1e3, 1e11, 1e13, 1e15}) {
    for (const Shape& a : {box, make_sphere(1)}) {
      for (const Shape& b : {box, make_sphere(1)}) {
        MovingPairCase c;
        c.a = a;
        c.b = b;
        c.pose_b.translation = {2.001, 0, 0};
        c.motion_b.displacement = {far, far, far};
        if (!takes(c)) continue;
        const CastOutcome outcome = solve(entry(), c, settings);
        EXPECT_NE(outcome.answer, CastAnswer::hit) << far;
        if (outcome.answer == CastAnswer::miss) ++answered;
      }
    }
  }
  EXPECT_GE(answered, 1);
}

TEST(ExactCastAtItsCap, IsUnknown) {
  const CastEntry& exact = *registry::find<CastEntry>("exact");
  MovingPairCase c;
  c.a = make_box(1, 1, 1);
  c.b = make_box(0.5, 0.5, 0.5);
  c.pose_b.translation = {1.5 * std::sqrt(3.0) + 1e-2, 0, 0};
  c.motion_a.rotation_vector = {30, 10, 3};
  c.motion_b.rotation_vector = {9, 30, 30};
  const CastOutcome free = solve(exact, c);
  EXPECT_EQ(free.answer, CastAnswer::miss);
  EXPECT_GT(free.iterations, 5);
  CastSettings settings;
  settings.max_iterations = 3;
  const CastOutcome capped = solve(exact, c, settings);
  EXPECT_EQ(capped.status, Status::not_converged);
  EXPECT_EQ(capped.answer, CastAnswer::unknown);
  EXPECT_LE(capped.iterations, 3);

  // Without a turn: a hull that passes corners takes more than one plane.
  Random random(2);
  int stopped = 0;
  settings.max_iterations = 1;
  for (int i = 0; i < 50; ++i) {
    const MovingPairCase meets =
        meeting(ShapeKind::hull, ShapeKind::hull, ContactFeature::vertices, 0.5, 2, random);
    const CastOutcome outcome = solve(exact, meets, settings);
    if (outcome.status == Status::not_converged) ++stopped;
    EXPECT_EQ(outcome.status == Status::ok, outcome.answer == CastAnswer::hit);
  }
  EXPECT_GE(stopped, 10);
}

}  // namespace
}  // namespace touchstone
