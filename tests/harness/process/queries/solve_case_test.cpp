// Tests that a case is answered in its own order of bodies, with only what is asked.
#include "harness/process/solve_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace touchstone {
namespace {

// A box and a ball to its right: kinds come in the other order in a batch.
files::Case box_and_ball(double x) {
  files::Case c;
  c.id = "x";
  c.shape_a.kind = ShapeKind::box;
  c.shape_a.half_extents = Vec3d(1, 1, 1);
  c.shape_b.kind = ShapeKind::sphere;
  c.shape_b.radius = 1;
  c.pose_b.translation = Vec3d(x, 0, 0);
  return c;
}

TEST(SolveCase, AnswersInTheOrderOfTheCase) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("exact");
  for (const double x : {4.0, 1.5}) {
    const Outcome outcome = process::solve_case(entry, {}, box_and_ball(x), Task::signed_distance);
    EXPECT_EQ(outcome.distance, x - 2);
    EXPECT_EQ(outcome.normal, Vec3d(1, 0, 0));
    EXPECT_EQ(outcome.witness_a, Vec3d(1, 0, 0));
    EXPECT_EQ(outcome.witness_b, Vec3d(x - 1, 0, 0));
  }
}

TEST(SolveCase, GivesWhatIsAsked) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("exact");
  const Outcome apart = process::solve_case(entry, {}, box_and_ball(4), Task::penetration);
  EXPECT_EQ(apart.answer, Answer::separated);
  EXPECT_TRUE(std::isnan(apart.distance) && apart.normal.hasNaN());
  const Outcome met = process::solve_case(entry, {}, box_and_ball(1.5), Task::distance);
  EXPECT_EQ(met.answer, Answer::overlapping);
  EXPECT_TRUE(std::isnan(met.distance) && met.witness_b.hasNaN());
}

}  // namespace
}  // namespace touchstone
