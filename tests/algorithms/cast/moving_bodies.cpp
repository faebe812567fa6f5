// Asks casts about moving pairs.
#include "tests/algorithms/cast/moving_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone::reference {

CastOutcome solve(const CastEntry& entry, const MovingPairCase& given,
                  const CastSettings& settings) {
  const bool swap = given.b.kind < given.a.kind;
  const MovingPairCase c = swap ? swapped(given) : given;
  const std::array<Shape, 2> shapes = {c.a, c.b};
  const std::array<Pose, 2> poses = {c.pose_a, c.pose_b};
  const std::array<Motion, 2> motions = {c.motion_a, c.motion_b};
  constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
  CastOutcome outcome;
  const std::unique_ptr<Cast> cast = entry.make(settings);
  cast->bind(shapes);
  const std::span<const std::uint32_t> both(bodies);
  cast->solve({.kind_a = c.a.kind,
               .kind_b = c.b.kind,
               .pairs = {both.subspan(0, 1), both.subspan(1, 1), bodies, poses},
               .motions = motions},
              {&outcome, 1});
  if (swap) outcome.normal = -outcome.normal;
  return outcome;
}

void expect_true(const CastEntry& entry, const MovingPairCase& c, const CastOutcome& outcome,
                 double tolerance, CastCounts& counts) {
  const std::string who = entry.info.name + ", " + c.what;
  // The exact answer may be either, or none, where rounding of the placement decides.
  const bool sure = entry.info.origin != Origin::oracle || (c.squarely && !(c.toi + c.doubt > 1));
  if (outcome.answer == CastAnswer::hit) ++counts.hits;
  if (outcome.answer == CastAnswer::miss) ++counts.misses;
  if (outcome.answer == CastAnswer::unknown) {
    EXPECT_NE(outcome.status, Status::ok) << who;
    if (sure) ++counts.unknown;
    return;
  }
  EXPECT_EQ(outcome.status, Status::ok) << who;
  if (outcome.answer == CastAnswer::miss) {
    // Rounding of the placement may also put contact at the very end after it.
    EXPECT_FALSE(c.hit && sure && !(c.toi + c.doubt > 1)) << who << ": missed at " << c.toi;
    EXPECT_TRUE(std::isnan(outcome.toi)) << who;
    return;
  }
  EXPECT_TRUE(c.hit || c.gap <= 1.01 * tolerance) << who << ": hit where the gap is " << c.gap;
  EXPECT_GE(outcome.toi, 0) << who;
  EXPECT_LE(outcome.toi, 1) << who;
  EXPECT_LE(outcome.lower, outcome.toi) << who;
  if (!std::isnan(outcome.upper)) {
    ++counts.brackets;
    EXPECT_GE(outcome.upper, outcome.lower) << who;
    EXPECT_TRUE(c.hit) << who << ": contact is said to be proven";
  }
  // What only grazes by construction may be touched later, for an exact answer.
  if (!c.hit || std::isnan(c.toi) || !sure) return;
  EXPECT_LE(outcome.lower, c.toi + c.doubt) << who;
  EXPECT_LE(outcome.toi, c.toi + c.doubt) << who;
  if (!std::isnan(outcome.upper)) {
    EXPECT_GE(outcome.upper, c.toi - c.doubt) << who;
  }
  if (c.speed > 0) {
    EXPECT_GE(outcome.toi, c.toi - c.doubt - 1.01 * tolerance / c.speed) << who;
  }
  if (!outcome.normal.hasNaN()) {
    EXPECT_NEAR(outcome.normal.norm(), 1, 1e-9) << who;
  }
}

}  // namespace touchstone::reference
