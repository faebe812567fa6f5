// FCL's two solvers on pairs whose answers are known.
#include <gtest/gtest.h>

#include <string>

#include "tests/algorithms/peers/narrow_pairs.h"

namespace touchstone {
namespace {

using namespace narrow_pairs;

constexpr std::array<double, 5> fcl_gaps = {1, 0.1, 0.01, -0.01, -0.05};
constexpr std::array<double, 3> apart = {1, 0.1, 0.01};
constexpr std::array<double, 2> overlaps = {-0.01, -0.05};

// FCL's own test of these is wrong: a cone whose tip points down, and any two half-spaces.
bool is_wrong_in_fcl(const KnownPair& pair) {
  return pair.b.shape.kind == ShapeKind::halfspace &&
         (pair.a.shape.kind == ShapeKind::cone || pair.a.shape.kind == ShapeKind::halfspace);
}

// FCL answers these without its solvers.
bool has_closed_form(const KnownPair& pair) {
  const ShapeKind a = pair.a.shape.kind, b = pair.b.shape.kind;
  if (b == ShapeKind::halfspace || (a == ShapeKind::box && b == ShapeKind::box)) return true;
  return a == ShapeKind::sphere && (b == ShapeKind::sphere || b == ShapeKind::capsule ||
                                    b == ShapeKind::box || b == ShapeKind::cylinder);
}

class FclTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
      ASSERT_NE(entry, nullptr);
      if (!is_built(entry->info)) GTEST_SKIP() << entry->info.reason;
    }
  }

  const NarrowPhaseEntry* libccd_ = registry::find<NarrowPhaseEntry>("fcl-libccd");
  const NarrowPhaseEntry* indep_ = registry::find<NarrowPhaseEntry>("fcl-indep");
};

TEST_F(FclTest, OffersWhatFclHas) {
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    EXPECT_EQ(entry->info.origin, Origin::peer);
    for (const Precision scalar : {Precision::float32, Precision::float64}) {
      EXPECT_TRUE(offers(*entry, scalar));
    }
    for (const ShapeKind kind : all_shape_kinds) {
      EXPECT_TRUE(offers(*entry, ShapeKind::halfspace, kind, Task::intersect));
      EXPECT_FALSE(offers(*entry, ShapeKind::halfspace, kind, Task::distance));
      EXPECT_EQ(offers(*entry, ShapeKind::halfspace, kind, Task::penetration),
                kind != ShapeKind::halfspace);
    }
  }
}

TEST_F(FclTest, TellsSeparatedFromOverlappingForEveryKindPair) {
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    for (const Precision scalar : {Precision::float64, Precision::float32}) {
      int pairs = 0, wrong = 0;
      for_known_pairs(*entry, Task::intersect, fcl_gaps, 2, [&](const KnownPair& pair) {
        if (is_wrong_in_fcl(pair)) return;
        const Outcome outcome = ask(*entry, Task::intersect, pair.a, pair.b, {.scalar = scalar});
        ASSERT_EQ(outcome.status, Status::not_reported);
        ASSERT_TRUE(std::isnan(outcome.distance));
        const bool right =
            outcome.answer == (pair.gap > 0 ? Answer::separated : Answer::overlapping);
        if (scalar == Precision::float64) {
          ASSERT_TRUE(right) << kinds_of(pair);
        }
        ++pairs;
        wrong += !right;
      });
      EXPECT_LT(wrong, 0.002 * pairs) << entry->info.name << to_string(scalar);
    }
  }
}

// FCL stops once a step gains too little, at times too early: in a few pairs the distance is far
// off. Whatever the distance, the witness points lie on the bodies and that far apart.
TEST_F(FclTest, GivesTheDistanceInAllButAFewPairs) {
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    for (const Precision scalar : {Precision::float64, Precision::float32}) {
      const bool is_double = scalar == Precision::float64;
      int pairs = 0, exact = 0;
      for_known_pairs(*entry, Task::distance, apart, 3, [&](const KnownPair& pair) {
        const Outcome outcome = ask(*entry, Task::distance, pair.a, pair.b, {.scalar = scalar});
        ++pairs;
        const double error = std::abs(outcome.distance - pair.gap);
        if (!(error < (is_double ? 1e-3 : 3e-3))) return;
        ++exact;
        ASSERT_EQ(outcome.answer, Answer::separated);
        ASSERT_EQ(outcome.status, Status::not_reported);
        const double rounding = is_double ? 1e-9 : 1e-5;
        EXPECT_LT(outside(pair.a, outcome.witness_a), rounding) << kinds_of(pair);
        EXPECT_LT(outside(pair.b, outcome.witness_b), rounding) << kinds_of(pair);
        EXPECT_NEAR((outcome.witness_b - outcome.witness_a).norm(), outcome.distance, rounding);
        EXPECT_GT((outcome.witness_b - outcome.witness_a).dot(pair.direction), 0.9 * pair.gap);
      });
      EXPECT_GT(exact, 0.99 * pairs) << entry->info.name << " " << to_string(scalar);
    }
  }
}

TEST_F(FclTest, GivesNoDistanceOfOverlappingBodies) {
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    for_known_pairs(*entry, Task::distance, overlaps, 1, [&](const KnownPair& pair) {
      const Outcome outcome = ask(*entry, Task::distance, pair.a, pair.b);
      ASSERT_EQ(outcome.answer, Answer::overlapping) << kinds_of(pair);
      ASSERT_TRUE(std::isnan(outcome.distance));
      ASSERT_TRUE(std::isnan(outcome.witness_a.x()));
    });
  }
}

TEST_F(FclTest, ClosedFormsGiveTheDepthAndTheNormal) {
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    for (const Precision scalar : {Precision::float64, Precision::float32}) {
      for_known_pairs(*entry, Task::penetration, fcl_gaps, 2, [&](const KnownPair& pair) {
        if (!has_closed_form(pair) || is_wrong_in_fcl(pair)) return;
        const Outcome outcome = ask(*entry, Task::penetration, pair.a, pair.b, {.scalar = scalar});
        ASSERT_EQ(outcome.status, Status::not_reported);
        ASSERT_EQ(outcome.answer, pair.gap > 0 ? Answer::separated : Answer::overlapping);
        if (pair.gap > 0) {
          ASSERT_TRUE(std::isnan(outcome.distance));
        } else if (pair.deep) {
          const double rounding = scalar == Precision::float64 ? 1e-9 : 1e-4;
          EXPECT_NEAR(outcome.distance, pair.gap, rounding) << kinds_of(pair);
          EXPECT_GT(outcome.normal.dot(pair.direction), 1 - rounding) << kinds_of(pair);
        }
      });
    }
  }
}

TEST_F(FclTest, LibccdSolverGivesADepthThatSeparates) {
  for_known_pairs(*libccd_, Task::penetration, overlaps, 2, [&](const KnownPair& pair) {
    if (has_closed_form(pair) || !pair.deep) return;
    const Outcome outcome = ask(*libccd_, Task::penetration, pair.a, pair.b, {.tolerance = 1e-8});
    EXPECT_GT(-outcome.distance, -pair.gap - 1e-6) << kinds_of(pair);
    EXPECT_LT(-outcome.distance, -pair.gap * 1.3) << kinds_of(pair);
    EXPECT_GT(outcome.normal.dot(pair.direction), 0.75) << kinds_of(pair);
  });
}

// Its EPA is often far off; but where the depth is right the normal must be, and that shows the
// sign and the frame that FCL gives them in.
TEST_F(FclTest, IndepSolverGivesDepthAndNormalInMostPairs) {
  int pairs = 0, exact = 0, aligned = 0;
  for_known_pairs(*indep_, Task::penetration, overlaps, 3, [&](const KnownPair& pair) {
    if (has_closed_form(pair) || !pair.deep) return;
    const Outcome outcome = ask(*indep_, Task::penetration, pair.a, pair.b);
    ++pairs;
    if (std::abs(outcome.distance - pair.gap) > 1e-4) return;
    ++exact;
    aligned += outcome.normal.dot(pair.direction) > 0.99;
  });
  EXPECT_GT(exact, 0.7 * pairs);
  EXPECT_GT(aligned, 0.98 * exact);
}

TEST_F(FclTest, ToleranceAndCapReachTheSolvers) {
  const Placed a = placed(shapes_of(ShapeKind::ellipsoid)[0]);
  Placed b = placed(shapes_of(ShapeKind::ellipsoid)[1]);
  b.pose.translation = {1.7, 1.2, -0.8};
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    const double fine = ask(*entry, Task::distance, a, b, {.tolerance = 1e-13}).distance;
    const double coarse = ask(*entry, Task::distance, a, b, {.tolerance = 1e-3}).distance;
    EXPECT_GT(fine, 0);
    EXPECT_GT(std::abs(coarse - fine), 1e-6) << entry->info.name;
    EXPECT_LT(std::abs(coarse - fine), 0.05) << entry->info.name;
    // Both solvers answer a search that is cut short as they answer an overlap.
    const Ask two_steps{.tolerance = 1e-13, .max_iterations = 2};
    EXPECT_EQ(ask(*entry, Task::distance, a, b, two_steps).answer, Answer::overlapping);
  }
  const Vec3d normal = Vec3d(1, 2, 3).normalized();
  b.pose.translation = 0.9 * normal;
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    const auto depth = [&](const Ask& how) {
      return ask(*entry, Task::penetration, a, b, how).distance;
    };
    EXPECT_GT(std::abs(depth({.tolerance = 1e-2}) - depth({.tolerance = 1e-9})), 1e-6);
    EXPECT_GT(std::abs(depth({.tolerance = 1e-9, .max_iterations = 5}) -
                       depth({.tolerance = 1e-9, .max_iterations = 100})),
              1e-6)
        << entry->info.name;
  }
}

TEST_F(FclTest, AnswersAgreeOnRandomPairs) {
  const NarrowPhaseEntry* mpr = registry::find<NarrowPhaseEntry>("libccd-mpr");
  ASSERT_NE(mpr, nullptr);
  std::vector<const NarrowPhaseEntry*> others = {indep_};
  if (is_built(mpr->info)) others.push_back(mpr);
  for (const NarrowPhaseEntry* other : others) {
    const Agreement count = agreement(*libccd_, *other, 60, {.tolerance = 1e-9});
    EXPECT_LE(count.disagree, 2) << other->info.name;
    EXPECT_GT(count.separated, 300);
    EXPECT_GT(count.overlapping, 300);
  }
}

TEST_F(FclTest, TakesFlatHulls) {
  const std::vector<Shape> flat = {
      flat_hull({{0.1, 0.2, 0}}, 0),
      flat_hull({{-0.5, 0, 0}, {0.5, 0.1, 0}}, 1),
      flat_hull({{-0.5, -0.4, 0}, {0.6, 0, 0}, {0, 0.7, 0}}, 2),
  };
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    for (const Shape& shape : flat) {
      const Placed body = placed(shape);
      Placed cube = placed(box({1, 1, 1}), {0.3, 0.2, 0.4});
      EXPECT_EQ(ask(*entry, Task::intersect, body, cube).answer, Answer::overlapping);
      cube.pose.translation.z() = 1.9;
      EXPECT_EQ(ask(*entry, Task::intersect, body, cube).answer, Answer::separated);
      EXPECT_NEAR(ask(*entry, Task::distance, body, cube).distance, 0.9, 1e-6);
      const Placed ground = placed(halfspace(Vec3d::UnitZ(), 0), {0, 0, 0.25});
      EXPECT_NEAR(ask(*entry, Task::penetration, body, ground).distance, -0.25, 1e-9);
    }
  }
}

// A hull of many vertices with one that belongs to no face: FCL must not walk along its edges.
TEST_F(FclTest, TakesHullsWithPointsInside) {
  Hull hull = *prism(20, 0.9, 0.7);
  hull.vertices.insert(hull.vertices.begin(), Vec3d(0.1, 0, 0));
  for (Hull::Face& face_of : hull.faces) {
    for (std::uint32_t& vertex : face_of.loop) ++vertex;
  }
  const Placed body = placed(hull_shape(std::make_shared<const Hull>(std::move(hull))));
  const Placed ball = placed(sphere(0.5), {0, 0, 1.5});
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    EXPECT_NEAR(ask(*entry, Task::distance, body, ball).distance, 0.3, 1e-4);
  }
}

TEST_F(FclTest, EndsOnCoincidentCentres) {
  for (const NarrowPhaseEntry* entry : {libccd_, indep_}) {
    for (const ShapeKind kind : all_shape_kinds) {
      if (kind == ShapeKind::halfspace) continue;
      const Placed body = placed(shapes_of(kind)[0]);
      for (const Task task : entry->tasks) {
        EXPECT_EQ(ask(*entry, task, body, body).answer, Answer::overlapping)
            << entry->info.name << " " << to_string(task) << " " << to_string(kind);
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
