// MuJoCo's pair functions on pairs whose answers are known.
#include <gtest/gtest.h>

#include <string>

#include "tests/algorithms/peers/narrow_pairs.h"

namespace touchstone {
namespace {

using namespace narrow_pairs;

// Beyond the floats of a mesh.
constexpr std::array<double, 6> mujoco_gaps = {1, 0.1, 1e-4, -1e-4, -0.01, -0.05};

class MujocoTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(entry_, nullptr);
    if (!is_built(entry_->info)) GTEST_SKIP() << entry_->info.reason;
  }

  const NarrowPhaseEntry* entry_ = registry::find<NarrowPhaseEntry>("mujoco");
};

bool both_are(const KnownPair& pair, ShapeKind kind) {
  return pair.a.shape.kind == kind && pair.b.shape.kind == kind;
}

TEST_F(MujocoTest, OffersAllButConesAndTwoPlanes) {
  for (const Task task : {Task::intersect, Task::penetration}) {
    for (const ShapeKind kind : all_shape_kinds) {
      EXPECT_EQ(
          offers(*entry_, std::min(ShapeKind::box, kind), std::max(ShapeKind::box, kind), task),
          kind != ShapeKind::cone)
          << to_string(kind);
    }
    EXPECT_FALSE(offers(*entry_, ShapeKind::hull, ShapeKind::halfspace, task));
    EXPECT_FALSE(offers(*entry_, ShapeKind::halfspace, ShapeKind::halfspace, task));
  }
  EXPECT_FALSE(offers(*entry_, ShapeKind::box, ShapeKind::box, Task::distance));
}

// A cylinder that stands on the plane, or nearly, may be let through.
bool is_let_through(const KnownPair& pair, const Outcome& outcome) {
  return pair.a.shape.kind == ShapeKind::cylinder && pair.b.shape.kind == ShapeKind::halfspace &&
         outcome.answer == Answer::separated;
}

TEST_F(MujocoTest, TellsSeparatedFromOverlapping) {
  int let_through = 0;
  for_known_pairs(*entry_, Task::intersect, mujoco_gaps, 4, [&](const KnownPair& pair) {
    const Outcome outcome = ask(*entry_, Task::intersect, pair.a, pair.b);
    ASSERT_EQ(outcome.status, Status::not_reported);
    ASSERT_TRUE(std::isnan(outcome.distance));
    if (pair.gap < 0 && is_let_through(pair, outcome)) {
      ++let_through;
      return;
    }
    ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping)
        << kinds_of(pair);
  });
  EXPECT_LE(let_through, 5);
}

// The known defect of two boxes, where faces meet: half of the depth. MPR's is an upper bound.
TEST_F(MujocoTest, GivesDepthAndNormal) {
  int exact = 0, halved = 0, bounds = 0;
  for_known_pairs(*entry_, Task::penetration, mujoco_gaps, 4, [&](const KnownPair& pair) {
    const Outcome outcome = ask(*entry_, Task::penetration, pair.a, pair.b);
    if (pair.gap > 0) {
      ASSERT_TRUE(std::isnan(outcome.distance));
      return;
    }
    if (!pair.deep || is_let_through(pair, outcome)) return;
    ASSERT_EQ(outcome.answer, Answer::overlapping) << kinds_of(pair);
    EXPECT_NEAR(outcome.normal.norm(), 1, 1e-6);
    if (both_are(pair, ShapeKind::box)) {
      halved += std::abs(outcome.distance - pair.gap / 2) < 1e-9;
      EXPECT_GE(outcome.distance, pair.gap - 1e-9) << kinds_of(pair);
    } else {
      // Less than the depth by MPR's tolerance only.
      EXPECT_LE(outcome.distance, pair.gap + 1e-5) << kinds_of(pair);
      exact += outcome.distance > pair.gap - 1e-5;
      ++bounds;
    }
  });
  EXPECT_GT(exact, bounds / 2);
  EXPECT_GT(halved, 0);
}

TEST_F(MujocoTest, TurnsTheAnswerForThePairInItsOwnOrder) {
  // MuJoCo's types have the cylinder before the box, and the plane before all.
  const Placed box_at_rest = placed(box({0.5, 0.4, 0.3}));
  const Placed above = placed(along_z(ShapeKind::cylinder, 0.3, 0.2), {0, 0, 0.45});
  const Outcome of_cylinder = ask(*entry_, Task::penetration, box_at_rest, above);
  EXPECT_NEAR(of_cylinder.distance, -0.05, 1e-5);
  EXPECT_GT(of_cylinder.normal.z(), 0.999);
  const Outcome of_plane =
      ask(*entry_, Task::penetration, box_at_rest, placed(halfspace({0, 0, 2}, -0.5), {1, 2, 0}));
  EXPECT_NEAR(of_plane.distance, -0.05, 1e-12);
  EXPECT_LT(of_plane.normal.z(), -0.999);
}

TEST_F(MujocoTest, AgreesOnRandomPairs) {
  const NarrowPhaseEntry* gjk = registry::find<NarrowPhaseEntry>("gjk");
  ASSERT_NE(gjk, nullptr);
  const Agreement count = agreement(*entry_, *gjk, 100, {});
  EXPECT_LE(count.disagree, 2);
  EXPECT_GT(count.separated, 200);
  EXPECT_GT(count.overlapping, 200);
}

}  // namespace
}  // namespace touchstone
