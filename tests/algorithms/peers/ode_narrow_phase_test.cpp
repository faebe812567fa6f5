// ODE's colliders on pairs whose answers are known.
#include <gtest/gtest.h>

#include <string>

#include "tests/algorithms/peers/narrow_pairs.h"

namespace touchstone {
namespace {

using namespace narrow_pairs;

constexpr std::array<double, 7> ode_gaps = {1, 0.1, 1e-3, 1e-9, -1e-9, -1e-3, -0.05};

class OdeNarrowPhaseTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(entry_, nullptr);
    if (!is_built(entry_->info)) GTEST_SKIP() << entry_->info.reason;
  }
  Outcome answer(Task task, const Placed& a, const Placed& b) const {
    return ask(*entry_, task, a, b, {.scalar = entry_->scalars.front()});
  }

  const NarrowPhaseEntry* entry_ = registry::find<NarrowPhaseEntry>("ode");
};

TEST_F(OdeNarrowPhaseTest, OffersSpheresCapsulesBoxesAndPlanes) {
  for (const Task task : {Task::intersect, Task::penetration}) {
    EXPECT_TRUE(offers(*entry_, ShapeKind::sphere, ShapeKind::sphere, task));
    EXPECT_TRUE(offers(*entry_, ShapeKind::capsule, ShapeKind::box, task));
    EXPECT_TRUE(offers(*entry_, ShapeKind::box, ShapeKind::halfspace, task));
    EXPECT_FALSE(offers(*entry_, ShapeKind::halfspace, ShapeKind::halfspace, task));
    EXPECT_FALSE(offers(*entry_, ShapeKind::box, ShapeKind::hull, task));
  }
  EXPECT_FALSE(offers(*entry_, ShapeKind::box, ShapeKind::box, Task::distance));
}

TEST_F(OdeNarrowPhaseTest, TellsSeparatedFromOverlapping) {
  for_known_pairs(*entry_, Task::intersect, ode_gaps, 4, [&](const KnownPair& pair) {
    const Outcome outcome = answer(Task::intersect, pair.a, pair.b);
    ASSERT_EQ(outcome.status, Status::not_reported);
    ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping)
        << kinds_of(pair);
    ASSERT_TRUE(std::isnan(outcome.distance));
  });
}

TEST_F(OdeNarrowPhaseTest, GivesDepthAndNormal) {
  for_known_pairs(*entry_, Task::penetration, ode_gaps, 4, [&](const KnownPair& pair) {
    const Outcome outcome = answer(Task::penetration, pair.a, pair.b);
    ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping);
    if (pair.gap > 0) {
      ASSERT_TRUE(std::isnan(outcome.distance));
      return;
    }
    EXPECT_NEAR(outcome.normal.norm(), 1, 1e-12);
    if (!pair.deep) return;
    // Faces count for deeper by a twentieth when an axis is chosen.
    const bool boxes = pair.a.shape.kind == ShapeKind::box && pair.b.shape.kind == ShapeKind::box;
    EXPECT_NEAR(outcome.distance, pair.gap, 1e-9 - (boxes ? 0.051 * pair.gap : 0))
        << kinds_of(pair);
    if (!boxes) {
      EXPECT_GT(outcome.normal.dot(pair.direction), 1 - 1e-6) << kinds_of(pair);
    }
  });
}

// Pairs of one shape, and of a shape with itself: a geom never collides with itself.
TEST_F(OdeNarrowPhaseTest, BodiesMayShareAShape) {
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box}) {
    const Shape shape = shapes_of(kind)[0];
    const std::vector<Shape> shapes = {shape};
    const std::vector<Pose> poses = {
        {}, {Mat3d::Identity(), {0.3, 0.2, 0.1}}, {Mat3d::Identity(), {9, 0, 0}}};
    const std::vector<std::uint32_t> first = {0, 0}, second = {1, 2}, shape_of = {0, 0, 0};
    const auto algorithm = entry_->make({.scalar = entry_->scalars.front()});
    algorithm->bind(shapes);
    std::array<Outcome, 2> outcomes;
    algorithm->solve(
        Task::intersect,
        {.kind_a = kind,
         .kind_b = kind,
         .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = poses}},
        outcomes);
    EXPECT_EQ(outcomes[0].answer, Answer::overlapping);
    EXPECT_EQ(outcomes[1].answer, Answer::separated);
  }
}

TEST_F(OdeNarrowPhaseTest, AgreesOnRandomPairs) {
  const NarrowPhaseEntry* closed_form = registry::find<NarrowPhaseEntry>("closed-form");
  ASSERT_NE(closed_form, nullptr);
  const Agreement count =
      agreement(*entry_, *closed_form, 200, {.scalar = entry_->scalars.front()});
  EXPECT_LE(count.disagree, 2);
  EXPECT_GT(count.separated, 200);
  EXPECT_GT(count.overlapping, 200);
}

}  // namespace
}  // namespace touchstone
