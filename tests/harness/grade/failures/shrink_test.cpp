// Tests that shrinking keeps failures and makes cases small.
#include "harness/grade/failures/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "algorithms/hull/convex_hull.h"
#include "harness/kinds/pair/regimes/check_shapes.h"
#include "harness/kinds/pair/regimes/regimes.h"
#include "tests/harness/check/exact_answer.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

files::Case made(const char* regime, std::uint64_t index) {
  return make(*kinds::find_regime(regime), 1, index);
}

// Returns the first case of the regime that fails.
files::Case first_failing(const char* regime, const grade::FailurePredicate& fails) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    files::Case c = made(regime, i);
    if (fails(c)) return c;
  }
  ADD_FAILURE() << "no case fails in " << regime;
  return {};
}

TEST(Shrink, FindsTheOneVertexThatMatters) {
  const Vec3d planted(0.123456789, -0.987654321, 0.5);
  files::Case c = made("random-mixed", 0);
  std::vector<Vec3d> vertices = made("gap-1e0", 0).shape_a.kind == ShapeKind::hull
                                    ? made("gap-1e0", 0).shape_a.hull->vertices
                                    : kinds::box_as_hull({1, 2, 3}).hull->vertices;
  vertices.insert(vertices.begin() + 3, planted);
  c.shape_a = hull_of(vertices);
  const auto fails = [&](const files::Case& x) {
    return x.shape_a.kind == ShapeKind::hull &&
           std::ranges::any_of(x.shape_a.hull->vertices,
                               [&](const Vec3d& v) { return v.x() == planted.x(); });
  };
  const files::Case small = grade::shrink(c, fails);
  EXPECT_TRUE(fails(small));
  EXPECT_EQ(small.id, c.id);
  // A solid has at least four vertices.
  EXPECT_EQ(small.shape_a.hull->vertices.size(), 4u);
  EXPECT_EQ(small.shape_a.hull->dimension, 3);
  int long_numbers = 0;
  for (const Vec3d& v : small.shape_a.hull->vertices) {
    for (const double x : v) long_numbers += 10 * x != std::round(10 * x);
  }
  EXPECT_EQ(long_numbers, 1);
  EXPECT_EQ(small.pose_a.rotation, Mat3d::Identity());
  EXPECT_EQ(small.pose_b.rotation, Mat3d::Identity());
  EXPECT_TRUE(small.pose_a.translation.isZero(0));
  EXPECT_TRUE(small.pose_b.translation.isZero(0));
}

TEST(Shrink, LeavesOverlappingHullsWithFewVerticesAndShortNumbers) {
  oracle::Oracle oracle;
  const auto fails = [&](const files::Case& c) {
    return c.shape_a.kind == ShapeKind::hull && c.shape_b.kind == ShapeKind::hull &&
           exact_verdict(oracle, c) == Answer::overlapping;
  };
  const files::Case c = first_failing("random-polytopes", fails);
  const files::Case small = grade::shrink(c, fails, 4000);
  EXPECT_TRUE(fails(small));
  EXPECT_LE(small.shape_a.hull->vertices.size() + small.shape_b.hull->vertices.size(), 8u);
  EXPECT_LT(files::to_json(small).size(), 600u) << files::to_json(small);
}

TEST(Shrink, KeepsASmallGap) {
  oracle::Oracle oracle;
  const auto fails = [&](const files::Case& c) {
    const oracle::Measure m = exact_measure(oracle, c);
    return m.answer == Answer::separated && m.upper < 1e-8 * grade::pair_size(c);
  };
  const files::Case c = first_failing("gap-1e-9", [&](const files::Case& x) {
    return fails(x) && x.shape_a.kind == ShapeKind::hull && x.shape_b.kind == ShapeKind::hull;
  });
  const files::Case small = grade::shrink(c, fails);
  EXPECT_TRUE(fails(small));
  EXPECT_LT(files::to_json(small).size(), files::to_json(c).size() / 2) << files::to_json(small);
}

TEST(Shrink, KeepsToItsBudgetAndIsTheSameEachTime) {
  const files::Case c = first_failing("random-polytopes", [](const files::Case& x) {
    return x.shape_a.kind == ShapeKind::hull && x.shape_a.hull->vertices.size() > 20;
  });
  for (const int budget : {0, 1, 10, 200}) {
    int calls = 0;
    const auto fails = [&](const files::Case& x) {
      ++calls;
      return x.shape_a.kind == ShapeKind::hull && x.shape_a.hull->vertices.size() >= 5 &&
             x.pose_b.translation.norm() > 0.25;
    };
    const std::string first = files::to_json(grade::shrink(c, fails, budget));
    EXPECT_LE(calls, budget);
    EXPECT_EQ(files::to_json(grade::shrink(c, fails, budget)), first);
    if (budget == 0) {
      EXPECT_EQ(first, files::to_json(c));
    }
  }
}

TEST(Shrink, EndsAndGivesCasesThatCanBeRead) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "cases.jsonl";
  int cases = 0;
  {
    std::ofstream stream(file);
    for (const kinds::Regime& regime : kinds::regimes()) {
      int calls = 0;
      const files::Case c = made(regime.name.c_str(), 1);
      const ShapeKind kind = c.shape_b.kind;
      // The first predicate allows no change.
      const files::Case same = grade::shrink(
          c, [&](const files::Case&) { return ++calls < 0; }, 100'000);
      EXPECT_EQ(files::to_json(same), files::to_json(c));
      EXPECT_LT(calls, 60'000);
      // The second predicate allows every change that keeps the kind.
      calls = 0;
      const files::Case small = grade::shrink(
          c, [&](const files::Case& x) { return ++calls > 0 && x.shape_b.kind == kind; }, 100'000);
      EXPECT_LT(calls, 1000) << files::to_json(small);
      EXPECT_TRUE(small.pose_b.translation.isZero(0));
      EXPECT_EQ(small.pose_b.rotation, Mat3d::Identity());
      stream << files::to_json(small) << "\n";
      ++cases;
    }
  }
  EXPECT_EQ(files::read_cases(file).size(), cases);
}

}  // namespace
}  // namespace touchstone
