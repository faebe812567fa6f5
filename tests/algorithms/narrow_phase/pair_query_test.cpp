// Tests that one pair is answered in either order of its kinds, with the outcome of that order.
#include "algorithms/pair_query.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/any_pairs.h"

namespace touchstone::pair_query_test {
namespace {

using namespace test;

TEST(PairQuery, SwapsKindsThatComeInTheOtherOrder) {
  EXPECT_FALSE(needs_swap(ShapeKind::sphere, ShapeKind::box));
  EXPECT_FALSE(needs_swap(ShapeKind::box, ShapeKind::box));
  EXPECT_TRUE(needs_swap(ShapeKind::box, ShapeKind::sphere));
}

TEST(PairQuery, TheOutcomeIsTurnedBack) {
  Outcome outcome;
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  outcome.distance = 2;
  outcome.normal = Vec3d(1, 0, -1);
  outcome.witness_a = Vec3d(1, 2, 3);
  outcome.witness_b = Vec3d(4, 5, 6);
  const Outcome turned = swapped(outcome);
  EXPECT_EQ(turned.distance, 2);
  EXPECT_EQ(turned.normal, Vec3d(-1, 0, 1));
  EXPECT_FALSE(std::signbit(turned.normal[1]));
  EXPECT_EQ(turned.witness_a, outcome.witness_b);
  EXPECT_EQ(turned.witness_b, outcome.witness_a);
  EXPECT_TRUE(swapped(Outcome{}).normal.hasNaN());
}

// Each kind with each, in both orders: what one says of a the other says of b.
TEST(PairQuery, AnswersInEitherOrder) {
  int separated = 0, overlapping = 0;
  for (const char* name : {"gjk", "closed-form", "certified"}) {
    const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>(name);
    for (const AnyPair& pair : any_pairs()) {
      if (!pair.is_bounded() || std::abs(pair.truth.middle()) < 1e-6) continue;
      const std::array<Shape, 2> shapes{pair.a, pair.b};
      PairQuery query(entry.make({}), shapes);
      for (const Task task : all_tasks) {
        if (!offers(entry, pair.a.kind, pair.b.kind, task)) continue;
        SCOPED_TRACE(std::string(name) + " " + pair.name + " " + std::string(to_string(task)));
        const PairAsked one{0, pair.pose_a, 1, pair.pose_b}, other{1, pair.pose_b, 0, pair.pose_a};
        for (const auto& solve : {&PairQuery::solve, &PairQuery::solve_as_batch}) {
          const Outcome of_one = (query.*solve)(task, one), of_other = (query.*solve)(task, other);
          EXPECT_EQ(of_one.answer, of_other.answer);
          EXPECT_EQ(std::isnan(of_one.distance), std::isnan(of_other.distance));
          separated += of_one.answer == Answer::separated;
          overlapping += of_one.answer == Answer::overlapping;
          if (std::isnan(of_one.distance) || of_one.status != Status::ok) continue;
          EXPECT_GT(of_one.distance * pair.truth.middle(), 0);
          // For one kind the algorithm itself sees another order, and may find another of several
          // shortest ways.
          if (pair.a.kind == pair.b.kind) {
            EXPECT_NEAR(of_one.distance, of_other.distance, 1e-8);
            EXPECT_GT(
                of_other.normal.dot(of_other.witness_b - of_other.witness_a) * of_other.distance,
                0);
          } else {
            EXPECT_EQ(of_one.distance, of_other.distance);
            EXPECT_EQ(of_one.normal, Vec3d(-of_other.normal));
            EXPECT_EQ(of_one.witness_a, of_other.witness_b);
            EXPECT_EQ(of_one.witness_b, of_other.witness_a);
          }
        }
        if (HasFailure()) return;
      }
    }
  }
  EXPECT_GT(separated, 500 / one_in);
  EXPECT_GT(overlapping, 500 / one_in);
}

// Bodies that come nearer frame by frame, each query from what the last one left.
TEST(PairQuery, RemembersAPair) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("gjk");
  const std::array<Shape, 2> shapes{tetrahedron(), box(1, 1, 1)};
  for (const std::optional<double> margin : {std::optional<double>(), std::optional(0.5)}) {
    PairQuery cold(entry.make({.margin = margin}), shapes);
    PairQuery warm(entry.make({.margin = margin}), shapes);
    PairMemory memory;
    int beyond = 0, numbers = 0, calls_warm = 0, calls_cold = 0;
    for (int frame = 0; frame < 400; ++frame) {
      const Pose pose_a{Mat3d::Identity(), Vec3d(5 - 0.01 * frame, 0.3, 0.2)};
      const Pose pose_b{Eigen::AngleAxisd(0.002 * frame, Vec3d::UnitZ()).toRotationMatrix(),
                        Vec3d::Zero()};
      const Outcome once = cold.solve(Task::signed_distance, {0, pose_a, 1, pose_b});
      const Outcome again = warm.solve(Task::signed_distance, {0, pose_a, 1, pose_b, &memory});
      ASSERT_EQ(once.status, Status::ok);
      ASSERT_EQ(again.status, Status::ok);
      ASSERT_EQ(once.answer, again.answer) << frame;
      calls_cold += once.support_calls;
      calls_warm += again.support_calls;
      if (std::isnan(once.distance) || std::isnan(again.distance)) {
        ++beyond;
        ASSERT_TRUE(margin.has_value());
        ASSERT_GE(again.lower, std::isnan(again.distance) ? *margin : *margin - 1e-9);
        continue;
      }
      ++numbers;
      ASSERT_NEAR(once.distance, again.distance, 1e-12);
    }
    EXPECT_EQ(beyond > 100, margin.has_value());
    EXPECT_GT(numbers, 100);
    EXPECT_LT(calls_warm, calls_cold);
  }
}

}  // namespace
}  // namespace touchstone::pair_query_test
