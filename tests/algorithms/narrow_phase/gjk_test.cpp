// GJK and EPA: polytopes against brute force, round shapes against closed forms, and what breaks
// such algorithms: nearly touching, flat, coincident, contained, needles, far away, very large and
// small.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/polytope_reference.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::gjk_test {
namespace {

using namespace reference;

std::unique_ptr<NarrowPhase> make_gjk(Precision scalar = Precision::float64) {
  NarrowPhaseSettings settings;
  settings.scalar = scalar;
  return registry::find<NarrowPhaseEntry>("gjk")->make(settings);
}

Pose at(const Vec3d& place, const Mat3d& rotation = Mat3d::Identity()) {
  return {.rotation = rotation, .translation = place};
}

Mat3d turned(double degrees, const Vec3d& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
}

Shape octahedron(double reach) {
  return make_hull({{reach, 0, 0},
                    {-reach, 0, 0},
                    {0, reach, 0},
                    {0, -reach, 0},
                    {0, 0, reach},
                    {0, 0, -reach}});
}

// Checks an outcome of any bodies: no wrong answer with `ok`, numbers within `tolerance`, bounds
// around them, witness points that fit. `signed_distance` is the truth.
void expect_right(const Outcome& outcome, Task task, double truth, double tolerance) {
  ASSERT_EQ(outcome.status, Status::ok);
  ASSERT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping);
  EXPECT_GT(outcome.iterations, -1);
  EXPECT_GT(outcome.support_calls, -1);
  const bool has_numbers = asks_for_number(task, outcome.answer);
  if (!has_numbers) {
    EXPECT_TRUE(std::isnan(outcome.distance));
    EXPECT_TRUE(outcome.witness_a.array().isNaN().all());
    return;
  }
  EXPECT_NEAR(outcome.distance, truth, tolerance);
  EXPECT_LE(outcome.lower, truth + std::abs(truth) * 1e-15);
  EXPECT_GE(outcome.upper, truth - std::abs(truth) * 1e-15);
  EXPECT_NEAR(outcome.normal.norm(), 1, 1e-6);
  const Vec3d between = outcome.witness_b - outcome.witness_a;
  const double reach = outcome.witness_a.norm() + outcome.witness_b.norm();
  EXPECT_LE((between - outcome.distance * outcome.normal).norm(), 10 * tolerance + 1e-15 * reach);
}

struct Regime {
  std::string name;
  double size_b = 1;  // a's is 1
  Vec3d stretch_a = {1, 1, 1}, stretch_b = {1, 1, 1};
  bool same_rotation = false;
  double scale = 1;
  double far = 0;         // from the world's origin, in sizes
  double margin = 1e-12;  // where no failure is accepted, as a part of the size
  double float_margin = 1e-4;
};

Shape random_polytope(Random& random, double size, const Vec3d& stretch, bool box) {
  if (box) {
    const Vec3d half = size * stretch;
    return make_box(half.x() * random.uniform(.3, 1), half.y() * random.uniform(.3, 1),
                    half.z() * random.uniform(.3, 1));
  }
  std::vector<Vec3d> vertices(4 + random.below(5));
  for (Vec3d& v : vertices) v = size * random.direction().cwiseProduct(stretch);
  return make_hull(std::move(vertices));
}

class Polytopes : public testing::TestWithParam<Regime> {
 protected:
  struct Pair {
    Body a, b;
    double truth, size;
  };
  // Every third pair stays as thrown; the others are moved to a gap or depth between 1e-1 and 1e-12
  // of the size, so that all pairs of features come close.
  Pair make(Random& random, int i) {
    const Regime& regime = GetParam();
    Pair pair;
    const double s = regime.scale;
    pair.a.shape = random_polytope(random, s, regime.stretch_a, random.below(2) == 0);
    pair.b.shape =
        random_polytope(random, s * regime.size_b, regime.stretch_b, random.below(2) == 0);
    pair.a.pose.rotation = random.rotation();
    pair.b.pose.rotation = regime.same_rotation ? pair.a.pose.rotation : random.rotation();
    pair.a.pose.translation = s * regime.far * random.direction();
    pair.b.pose.translation =
        pair.a.pose.translation + s * random.uniform(0, 1.8) * random.direction();
    Vec3d normal;
    const auto thrown = static_cast<double>(signed_distance(pair.a, pair.b, normal));
    if (i % 3 != 0) {
      const double sign = random.below(2) ? 1 : -1;
      const double target = sign * s * std::pow(10, random.uniform(-12, -1));
      pair.b.pose.translation += (target - thrown) * normal;
    }
    pair.truth = static_cast<double>(signed_distance(pair.a, pair.b, normal));
    pair.size = pair_size(pair.a, pair.b);
    return pair;
  }
};

TEST_P(Polytopes, AgreeWithBruteForceInDouble) {
  const auto gjk = make_gjk();
  Random random(1);
  int apart = 0;
  int common = 0;
  for (int i = 0; i < drawn(240, 80); ++i) {
    const Pair pair = make(random, i);
    if (!(std::abs(pair.truth) >= GetParam().margin * pair.size)) continue;
    ++(pair.truth > 0 ? apart : common);
    for (const Task task : all_tasks) {
      SCOPED_TRACE(std::string(to_string(task)) + " of pair " + std::to_string(i));
      const Outcome outcome = query(*gjk, task, pair.a, pair.b);
      expect_right(outcome, task, pair.truth, 1e-14 * pair.size);
      const Outcome back = query(*gjk, task, pair.b, pair.a);
      expect_right(back, task, pair.truth, 1e-14 * pair.size);
    }
  }
  EXPECT_GT(apart, one_in == 1 ? 20 : 3);
  EXPECT_GT(common, one_in == 1 ? 20 : 3);
}

TEST_P(Polytopes, AreHonestInFloat) {
  const auto gjk = make_gjk(Precision::float32);
  Random random(2);
  for (int i = 0; i < drawn(240, 80); ++i) {
    const Pair pair = make(random, i);
    const double truth = pair.truth / pair.size;
    for (const Task task : all_tasks) {
      SCOPED_TRACE(std::string(to_string(task)) + " of pair " + std::to_string(i));
      const Outcome outcome = query(*gjk, task, pair.a, pair.b);
      if (outcome.status != Status::ok) {
        EXPECT_LT(std::abs(truth), GetParam().float_margin);
      } else if (std::abs(truth) >= GetParam().float_margin) {
        EXPECT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping);
        if (!std::isnan(outcome.distance)) {
          EXPECT_NEAR(outcome.distance / pair.size, truth, 1e-5);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Gjk, Polytopes,
    testing::Values(
        Regime{.name = "Unit", .float_margin = 1e-5},
        Regime{.name = "SameRotation", .same_rotation = true, .float_margin = 1e-5},
        Regime{.name = "Needle", .stretch_a = {1, 1e-8, 1e-8}, .margin = 1e-9},
        Regime{.name = "Needles", .stretch_a = {1, 1e-8, 1e-8}, .stretch_b = {1, 1e-8, 1e-8}},
        Regime{.name = "ParallelNeedles",
               .stretch_a = {1, 1e-8, 1e-8},
               .stretch_b = {1, 1e-8, 1e-8},
               .same_rotation = true},
        Regime{.name = "ThickNeedles", .stretch_a = {1, 1e-4, 1e-4}, .stretch_b = {1, 1e-4, 1e-4}},
        Regime{.name = "Plates", .stretch_a = {1, 1, 1e-8}, .stretch_b = {1, 1, 1e-8}},
        Regime{.name = "ParallelPlates",
               .stretch_a = {1, 1, 1e-8},
               .stretch_b = {1, 1, 1e-8},
               .same_rotation = true},
        Regime{.name = "PlateAndNeedle", .stretch_a = {1, 1, 1e-8}, .stretch_b = {1, 1e-8, 1e-8}},
        Regime{.name = "Nanometres", .scale = 1e-9, .float_margin = 1e-5},
        Regime{.name = "Gigametres", .scale = 1e9, .float_margin = 1e-5},
        Regime{.name = "BeyondFloat", .scale = 1e60, .float_margin = 1e-5},
        Regime{.name = "BelowFloat", .scale = 1e-60, .float_margin = 1e-5},
        Regime{.name = "Ratio1e6", .size_b = 1e-6},
        Regime{.name = "Ratio1e12", .size_b = 1e-12, .margin = 1e-11},
        Regime{.name = "FarAway", .far = 1e8, .margin = 1e-9}),
    [](const auto& param) { return param.param.name; });

// Bodies on the x axis that reach just as far to both sides of their centre, there on the axis.
struct Piece {
  Body body;
  double forward, backward;
};

std::vector<Piece> pieces() {
  const Mat3d tip_forward = turned(90, {0, 1, 0});
  const Mat3d roll = turned(33, {1, 0, 0});
  return {{{make_sphere(0.7), {}}, 0.7, 0.7},
          {{make_capsule(0.3, 0.5), {}}, 0.3, 0.3},
          {{make_capsule(0.3, 0.5), at({0, 0, 0}, tip_forward)}, 0.8, 0.8},
          {{make_box(0.5, 0.6, 0.7), at({0, 0, 0}, roll)}, 0.5, 0.5},
          {{make_cylinder(0.4, 0.6), {}}, 0.4, 0.4},
          {{make_cylinder(0.4, 0.6), at({0, 0, 0}, tip_forward)}, 0.6, 0.6},
          {{make_cone(0.4, 0.6), at({0, 0, 0}, tip_forward)}, 0.6, 0.6},
          {{make_ellipsoid(0.9, 0.5, 0.3), at({0, 0, 0}, roll)}, 0.9, 0.9},
          {{octahedron(0.8), at({0, 0, 0}, roll)}, 0.8, 0.8}};
}

TEST(GjkByHand, EveryPairOfKindsOnALine) {
  const std::vector<Piece> all = pieces();
  for (const Precision scalar : {Precision::float64, Precision::float32}) {
    const auto gjk = make_gjk(scalar);
    const bool wide = scalar == Precision::float64;
    for (const double gap : {1.5, 0.2, 1e-3, wide ? 1e-10 : 1e-4}) {
      for (const Piece& a : all) {
        for (Piece b : all) {
          SCOPED_TRACE(std::string(to_string(a.body.shape.kind)) + " and " +
                       std::string(to_string(b.body.shape.kind)));
          b.body.pose.translation.x() = a.forward + gap + b.backward;
          const Outcome outcome = query(*gjk, Task::distance, a.body, b.body);
          expect_right(outcome, Task::distance, gap, wide ? 1e-9 : 1e-4);
          if (HasFailure()) return;
          EXPECT_NEAR(outcome.normal.x(), 1, 1e-4);
          EXPECT_EQ(query(*gjk, Task::intersect, a.body, b.body).answer, Answer::separated);
          EXPECT_EQ(query(*gjk, Task::penetration, a.body, b.body).answer, Answer::separated);
          if (a.body.shape.kind != ShapeKind::hull && b.body.shape.kind != ShapeKind::hull) {
            EXPECT_LE(outside_by(a.body, outcome.witness_a), wide ? 1e-9 : 1e-4);
            EXPECT_LE(outside_by(b.body, outcome.witness_b), wide ? 1e-9 : 1e-4);
          }
        }
      }
    }
  }
}

// Overlapping along the axis by much or by little: the depth is at most that, no direction of
// a few hundred has less, and a translation by a little more than the depth parts the bodies.
TEST(GjkByHand, DepthIsTheLeastOfManyDirections) {
  const auto gjk = make_gjk();
  const std::vector<Piece> all = pieces();
  Random random(3);
  int converged = 0;
  int capped = 0;
  for (const double overlap : {1e-6, 1e-2, 0.3}) {
    for (const Piece& a : all) {
      for (Piece b : all) {
        SCOPED_TRACE(std::string(to_string(a.body.shape.kind)) + " and " +
                     std::string(to_string(b.body.shape.kind)) + " " + std::to_string(overlap));
        b.body.pose.translation = {a.forward - overlap + b.backward, 0, 0};
        const Outcome outcome = query(*gjk, Task::penetration, a.body, b.body);
        ASSERT_EQ(outcome.answer, Answer::overlapping);
        ++(outcome.status == Status::ok ? converged : capped);
        const double depth = -outcome.distance;
        EXPECT_LE(depth, overlap + 1e-9);
        EXPECT_LE(-outcome.upper, depth);
        EXPECT_GE(-outcome.lower, depth);
        if (outcome.status == Status::ok) {
          EXPECT_LE(depth + outcome.upper, 1e-9);
        }
        Body moved = b.body;
        moved.pose.translation += (depth + 1e-9) * outcome.normal;
        EXPECT_EQ(query(*gjk, Task::intersect, a.body, moved).answer, Answer::separated);
        if (outcome.status != Status::ok) continue;
        EXPECT_NEAR((outcome.witness_a - outcome.witness_b - depth * outcome.normal).norm(), 0,
                    1e-8);
        for (int i = 0; i < 30; ++i) {
          moved.pose.translation = b.body.pose.translation + (depth - 1e-9) * random.direction();
          EXPECT_EQ(query(*gjk, Task::intersect, a.body, moved).answer, Answer::overlapping);
        }
        if (a.body.shape.kind != ShapeKind::hull && b.body.shape.kind != ShapeKind::hull) {
          EXPECT_LE(outside_by(a.body, outcome.witness_a), 1e-8);
          EXPECT_LE(outside_by(b.body, outcome.witness_b), 1e-8);
        }
      }
    }
  }
  RecordProperty("capped", capped);
  EXPECT_GT(converged, 20 * capped);
}

}  // namespace
}  // namespace touchstone::gjk_test
