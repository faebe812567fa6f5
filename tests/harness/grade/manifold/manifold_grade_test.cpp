// Ours against the oracle and the touching area, and the grader against answers that are wrong.
#include "harness/grade/manifold/manifold_grade.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "harness/grade/manifold/touching_area.h"
#include "harness/kinds/manifold/manifold_kind.h"
#include "harness/kinds/pair/regimes/regimes.h"
#include "harness/process/solve_case.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using reference::make_box;

files::Case box_on_box() {
  files::Case c;
  c.id = "box";
  c.shape_a = make_box(2, 2, 1);
  c.shape_b = make_box(1, 1, 1);
  c.pose_b.translation = {0, 0, 1.99};
  return c;
}

const ManifoldEntry& ours() { return *registry::find<ManifoldEntry>("clipped-faces"); }

TEST(ManifoldGrade, OursOnEveryFamily) {
  for (const Precision scalar : {Precision::float64, Precision::float32}) {
    grade::ManifoldTally tally;
    int with_area = 0;
    for (const kinds::SettledFamily& family : kinds::settled_families()) {
      for (std::uint64_t i = 0; i < 12; ++i) {
        const files::Case c = kinds::settled_pair(family, 5, i);
        const grade::ManifoldTruth truth = grade::manifold_truth(c);
        EXPECT_TRUE(truth.overlap()) << c.id;
        const Manifold manifold = process::solve_manifold(ours(), {.scalar = scalar}, c);
        tally.add(std::string(family.name), "ours", ours().info, scalar, c, truth, manifold);
        with_area += grade::grade(c, truth, manifold).of_all ? 1 : 0;
      }
    }
    EXPECT_THAT(tally.ours_wrong(), testing::IsEmpty());
    EXPECT_GT(with_area, static_cast<int>(kinds::settled_families().size()) * 9);
  }
}

// Pairs of every kind and pose, at every gap and depth, degenerate and extreme: points are on their
// bodies, and the deepest is among them.
TEST(ManifoldGrade, OursOnEveryRegime) {
  int apart = 0, common = 0, several = 0;
  for (const kinds::Regime& regime : kinds::regimes()) {
    for (std::uint64_t i = 0; i < 12; ++i) {
      const files::Case c = make(regime, 11, i);
      if (!offers(ours(), c.shape_a.kind, c.shape_b.kind)) continue;
      for (const Precision scalar : {Precision::float64, Precision::float32}) {
        const Manifold manifold = process::solve_manifold(ours(), {.scalar = scalar}, c);
        several += manifold.count > 1 ? 1 : 0;
        if (manifold.answer == Answer::separated) {
          EXPECT_EQ(manifold.count, 0);
          ++apart;
          continue;
        }
        const grade::ManifoldTruth truth = grade::manifold_truth(c);
        common += truth.overlap() ? 1 : 0;
        const grade::ManifoldGrade graded = grade::grade(c, truth, manifold);
        const double rounding = grade::coordinate_rounding(c, truth);
        const double limit = scalar == Precision::float64 ? 1e-13 : 1e-4;
        EXPECT_LE(graded.off_body, limit + rounding) << c.id;
        EXPECT_EQ(graded.apart, 0) << c.id;
        if (manifold.status != Status::ok) continue;
        // Curved bodies are as far off the line as EPA's tolerance.
        const auto is_curved = [](const Shape& shape) {
          return shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone ||
                 shape.kind == ShapeKind::ellipsoid;
        };
        const bool curved = is_curved(c.shape_a) || is_curved(c.shape_b);
        const double off_line = scalar == Precision::float64 && curved ? 1e-9 : limit;
        EXPECT_LE(graded.off_line, off_line + 2 * rounding) << c.id;
        EXPECT_FALSE(graded.missed) << c.id;
        EXPECT_LE(graded.depth_error, (scalar == Precision::float64 ? 1e-8 : 1e-4) + rounding)
            << c.id;
      }
    }
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(common, 200);
  EXPECT_GT(several, 100);
}

TEST(ManifoldGrade, SeesWhatIsWrong) {
  const files::Case c = box_on_box();
  const grade::ManifoldTruth truth = grade::manifold_truth(c);
  EXPECT_EQ(truth.size, 4);
  EXPECT_NEAR(truth.depth, 0.01, 1e-15);
  const Manifold right = process::solve_manifold(ours(), {}, c);
  const grade::ManifoldGrade good = grade::grade(c, truth, right);
  EXPECT_LT(good.off_body, 1e-15);
  EXPECT_LT(good.depth_error, 1e-15);
  EXPECT_NEAR(good.of_best_four.value(), 1, 1e-14);
  EXPECT_NEAR(good.of_all.value(), 1, 1e-14);

  Manifold off = right;
  off.points[1].on_b.z() -= 0.1;  // below b
  EXPECT_NEAR(grade::grade(c, truth, off).off_body, 0.1 / 4, 1e-15);
  EXPECT_NEAR(grade::grade(c, truth, off).off_line, 0.1 / 4, 1e-15);
  Manifold shallow = right;
  for (ContactPoint& point : shallow.points) point.depth /= 2;
  EXPECT_NEAR(grade::grade(c, truth, shallow).depth_error, 0.005 / 4, 1e-15);
  Manifold apart = right;
  apart.points[2].depth = -0.04;
  EXPECT_NEAR(grade::grade(c, truth, apart).apart, 0.01, 1e-15);
  Manifold three = right;
  three.count = 3;
  EXPECT_NEAR(grade::grade(c, truth, three).of_best_four.value(), 0.5, 1e-14);
  Manifold none = right;
  none.count = 0;
  EXPECT_TRUE(grade::grade(c, truth, none).missed);

  grade::ManifoldTally tally;
  for (const Manifold& wrong : {off, shallow, three, none}) {
    tally.add("boxes", "ours", ours().info, Precision::float64, c, truth, wrong);
  }
  EXPECT_THAT(tally.ours_wrong(), testing::SizeIs(6));
  EXPECT_THAT(tally.table().markdown(), testing::HasSubstr("| boxes | ours | 4 | 1 | 3 to 4 |"));
}

TEST(ManifoldGrade, TouchingAreaIsWhereOneFaceIsBelowTheOther) {
  files::Case c = box_on_box();
  c.shape_b = make_box(4, 4, 1);
  c.pose_b.rotation = Eigen::AngleAxisd(0.1, Vec3d::UnitY()).toRotationMatrix();
  // b's lower face crosses a's upper one at x = 0.
  c.pose_b.translation = {0, 0, 1 + 1 / std::cos(0.1)};
  const auto area = grade::touching_area(c, grade::area_frame(c, Vec3d::UnitZ()));
  ASSERT_TRUE(area);
  EXPECT_NEAR(static_cast<double>(grade::hull_area(*area)), 8, 1e-13);
  files::Case sphere = c;
  sphere.shape_b = reference::make_sphere(1);
  EXPECT_FALSE(grade::touching_area(sphere, grade::area_frame(c, Vec3d::UnitZ())));
}

TEST(SettledPairs, AreTheSameAgainAndOtherwiseOthers) {
  for (const kinds::SettledFamily& family : kinds::settled_families()) {
    const files::Case one = kinds::settled_pair(family, 1, 3);
    EXPECT_EQ(files::to_json(one), files::to_json(kinds::settled_pair(family, 1, 3)));
    EXPECT_NE(files::to_json(one), files::to_json(kinds::settled_pair(family, 2, 3)));
    EXPECT_EQ(one.id, fmt::format("{}/3", family.name));
  }
}

}  // namespace
}  // namespace touchstone
