// libccd's GJK, EPA and MPR on pairs whose answers are known.
#include <gtest/gtest.h>

#include <string>

#include "tests/algorithms/peers/narrow_pairs.h"

namespace touchstone {
namespace {

using namespace narrow_pairs;

constexpr std::array<double, 5> libccd_gaps = {1, 0.1, 0.01, -0.01, -0.05};
constexpr std::array<double, 2> ccd_overlaps = {-0.01, -0.05};

class LibccdTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const NarrowPhaseEntry* entry : {gjk_, epa_, mpr_}) {
      ASSERT_NE(entry, nullptr);
      if (!is_built(entry->info)) GTEST_SKIP() << entry->info.reason;
    }
  }

  const NarrowPhaseEntry* gjk_ = registry::find<NarrowPhaseEntry>("libccd-gjk");
  const NarrowPhaseEntry* epa_ = registry::find<NarrowPhaseEntry>("libccd-epa");
  const NarrowPhaseEntry* mpr_ = registry::find<NarrowPhaseEntry>("libccd-mpr");
};

TEST_F(LibccdTest, OffersBoundedShapesInDouble) {
  for (const NarrowPhaseEntry* entry : {gjk_, epa_, mpr_}) {
    EXPECT_EQ(entry->info.origin, Origin::peer);
    EXPECT_TRUE(offers(*entry, Precision::float64));
    EXPECT_FALSE(offers(*entry, Precision::float32));
    EXPECT_FALSE(offers(*entry, Task::distance));
    for (const ShapeKind kind : all_shape_kinds) {
      EXPECT_EQ(offers(*entry, ShapeKind::box, kind, entry->tasks.front()),
                kind != ShapeKind::halfspace);
    }
  }
}

TEST_F(LibccdTest, TellsSeparatedFromOverlappingForEveryKindPair) {
  for (const NarrowPhaseEntry* entry : {gjk_, mpr_}) {
    for_known_pairs(*entry, Task::intersect, libccd_gaps, 2, [&](const KnownPair& pair) {
      const Outcome outcome = ask(*entry, Task::intersect, pair.a, pair.b);
      ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping)
          << entry->info.name << ": " << to_string(pair.a.shape.kind) << ", "
          << to_string(pair.b.shape.kind) << ", gap " << pair.gap;
      ASSERT_EQ(outcome.status, Status::not_reported);
      ASSERT_GT(outcome.support_calls, 0);
      ASSERT_TRUE(std::isnan(outcome.distance));
    });
  }
}

TEST_F(LibccdTest, MprGivesADepthThatSeparates) {
  for_known_pairs(*mpr_, Task::penetration, libccd_gaps, 2, [&](const KnownPair& pair) {
    const Outcome outcome = ask(*mpr_, Task::penetration, pair.a, pair.b, {.tolerance = 1e-8});
    ASSERT_EQ(outcome.status, Status::not_reported);
    ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping);
    if (pair.gap > 0) {
      ASSERT_TRUE(std::isnan(outcome.distance));
    } else if (pair.deep) {
      const std::string kinds = std::string(to_string(pair.a.shape.kind)) + ", " +
                                std::string(to_string(pair.b.shape.kind));
      EXPECT_GT(-outcome.distance, -pair.gap - 1e-6) << kinds;
      EXPECT_LT(-outcome.distance, -pair.gap * 1.3) << kinds;
      EXPECT_NEAR(outcome.normal.norm(), 1, 1e-9);
      EXPECT_GT(outcome.normal.dot(pair.direction), 0.75) << kinds;
    }
  });
}

TEST_F(LibccdTest, EpaGivesTheDepthInAllButAFewPairs) {
  int pairs = 0, exact = 0;
  for_known_pairs(*epa_, Task::penetration, libccd_gaps, 1, [&](const KnownPair& pair) {
    const Outcome outcome = ask(*epa_, Task::penetration, pair.a, pair.b, {.tolerance = 1e-6});
    ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping);
    if (pair.gap > 0) {
      ASSERT_TRUE(std::isnan(outcome.distance));
    } else if (pair.deep) {
      ++pairs;
      exact +=
          std::abs(outcome.distance - pair.gap) < 1e-5 && outcome.normal.dot(pair.direction) > 0.99;
    }
  });
  EXPECT_GT(exact, 0.98 * pairs) << "of " << pairs;
}

TEST_F(LibccdTest, ToleranceReachesTheLibrary) {
  const Placed a = placed(shapes_of(ShapeKind::ellipsoid)[0]);
  for (const NarrowPhaseEntry* entry : {epa_, mpr_}) {
    double coarse = 0, fine = 0;
    std::mt19937_64 random(3);
    for (int i = 0; i < 20; ++i) {
      const Placed b = placed(shapes_of(ShapeKind::ellipsoid)[1], 0.9 * random_unit(random));
      const auto depth = [&](double tolerance) {
        return ask(*entry, Task::penetration, a, b, {.tolerance = tolerance}).distance;
      };
      const double exact = depth(1e-9);
      coarse += std::abs(depth(1e-2) - exact) / 20;
      fine += std::abs(depth(1e-6) - exact) / 20;
    }
    EXPECT_GT(coarse, 1e-4) << entry->info.name;
    EXPECT_LT(fine, 1e-2 * coarse) << entry->info.name;
  }
}

TEST_F(LibccdTest, SaysWhenTheIterationsRanOut) {
  for (const NarrowPhaseEntry* entry : {gjk_, mpr_}) {
    int not_converged = 0;
    for_known_pairs(*entry, Task::intersect, libccd_gaps, 1, [&](const KnownPair& pair) {
      const Outcome outcome = ask(*entry, Task::intersect, pair.a, pair.b, {.max_iterations = 1});
      if (outcome.status == Status::not_converged) {
        ++not_converged;
        ASSERT_EQ(outcome.answer, Answer::unknown);
      } else {
        ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping);
      }
    });
    EXPECT_GT(not_converged, 100) << entry->info.name;
  }
  int capped = 0;
  for_known_pairs(*epa_, Task::penetration, ccd_overlaps, 1, [&](const KnownPair& pair) {
    const Ask how{.tolerance = 1e-9, .max_iterations = 10};
    const Outcome outcome = ask(*epa_, Task::penetration, pair.a, pair.b, how);
    if (outcome.answer == Answer::separated) ADD_FAILURE() << "a wrong answer for a short search";
    if (outcome.status == Status::not_converged && outcome.answer == Answer::overlapping) {
      ++capped;
      EXPECT_GE(-pair.gap * 1.001, -outcome.distance);  // EPA comes from inside
    }
  });
  EXPECT_GT(capped, 100);
}

// Without the cap, EPA does not come back from these.
TEST_F(LibccdTest, EndsOnCoincidentCentres) {
  for (const ShapeKind kind : all_shape_kinds) {
    if (kind == ShapeKind::halfspace) continue;
    for (const double tolerance : {1e-6, 1e-12, 1e-15}) {
      for (const NarrowPhaseEntry* entry : {epa_, mpr_}) {
        const Placed body = placed(shapes_of(kind)[0]);
        const Outcome outcome =
            ask(*entry, Task::penetration, body, body, {.tolerance = tolerance});
        EXPECT_EQ(outcome.answer, Answer::overlapping) << entry->info.name << to_string(kind);
      }
    }
  }
}

TEST_F(LibccdTest, AnswersAgreeOnRandomPairs) {
  const Agreement count = agreement(*gjk_, *mpr_, 60, {.tolerance = 1e-9});
  EXPECT_EQ(count.disagree, 0);
  EXPECT_GT(count.separated, 300);
  EXPECT_GT(count.overlapping, 300);
}

TEST_F(LibccdTest, TakesFlatHullsAndZeroSizes) {
  const std::vector<Shape> thin = {
      flat_hull({{0.1, 0.2, 0}}, 0),
      flat_hull({{-0.5, 0, 0}, {0.5, 0.1, 0}}, 1),
      flat_hull({{-0.5, -0.4, 0}, {0.6, 0, 0}, {0, 0.7, 0}}, 2),
      sphere(0),
      along_z(ShapeKind::capsule, 0, 0.5),
      box({0.5, 0.4, 0}),
      along_z(ShapeKind::cylinder, 0.5, 0),
      ellipsoid({0.5, 0.3, 0}),
  };
  for (const Shape& shape : thin) {
    for (const NarrowPhaseEntry* entry : {gjk_, mpr_}) {
      const Placed body = placed(shape);
      EXPECT_EQ(ask(*entry, Task::intersect, body, placed(box({1, 1, 1}), {0.3, 0.2, 0.4})).answer,
                Answer::overlapping)
          << to_string(shape.kind);
      EXPECT_EQ(ask(*entry, Task::intersect, body, placed(box({1, 1, 1}), {0.3, 0.2, 1.9})).answer,
                Answer::separated)
          << to_string(shape.kind);
    }
  }
}

// The pose is a matrix to be used as it stands: here it makes the box twice as large, and leaves
// the ball a ball.
TEST_F(LibccdTest, UsesTheRotationAsItStands) {
  Placed large = placed(box({1, 1, 1}), Vec3d::Zero());
  large.pose.rotation *= 2;
  Placed ball = placed(sphere(0.6), {2.5, 0.1, 0});
  ball.pose.rotation *= 2;
  for (const NarrowPhaseEntry* entry : {gjk_, mpr_}) {
    EXPECT_EQ(ask(*entry, Task::intersect, large, ball).answer, Answer::overlapping);
    ball.pose.translation.x() = 2.7;
    EXPECT_EQ(ask(*entry, Task::intersect, large, ball).answer, Answer::separated);
    ball.pose.translation.x() = 2.5;
  }
}

TEST_F(LibccdTest, AnswersABatchInItsOrder) {
  const std::vector<Shape> shapes = {sphere(1), box({1, 1, 1})};
  std::vector<Pose> poses(4);
  poses[1].translation = {1.5, 0, 0};
  poses[2].translation = {2.25, 0, 0};
  poses[3].translation = {0, 9, 0};
  const std::vector<std::uint32_t> shape_of = {0, 1, 1, 1}, first = {0, 0, 0}, second = {3, 1, 2};
  const auto algorithm = mpr_->make(Ask{.tolerance = 1e-9}.settings());
  algorithm->bind(shapes);
  std::vector<Outcome> outcomes(3);
  algorithm->solve(
      Task::penetration,
      {.kind_a = ShapeKind::sphere,
       .kind_b = ShapeKind::box,
       .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = poses}},
      outcomes);
  EXPECT_EQ(outcomes[0].answer, Answer::separated);
  EXPECT_EQ(outcomes[1].answer, Answer::overlapping);
  EXPECT_EQ(outcomes[2].answer, Answer::separated);
  EXPECT_NEAR(outcomes[1].distance, -0.5, 1e-6);
  EXPECT_NEAR(outcomes[1].normal.x(), 1, 1e-6);
}

}  // namespace
}  // namespace touchstone
