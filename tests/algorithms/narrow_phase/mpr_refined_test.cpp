// Tests the promises of mpr-refined beyond the contract: never more than mpr's depth, bounds that
// hold, the least depth for most pairs, and warm starts that are never worse than cold ones.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/bodies.h"
#include "tests/algorithms/narrow_phase/brute_force.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::mpr_refined_test {
namespace {

using namespace test;

struct Body {
  Shape shape;
  Pose pose;
};

Outcome ask_named(const char* name, Precision scalar, const Body& a, const Body& b,
                  Task task = Task::penetration) {
  return ask(*registry::find<NarrowPhaseEntry>(name), settings_of(scalar), task, a.shape, a.pose,
             b.shape, b.pose);
}

// The distance by which b must move along a direction until a plane across it separates the bodies.
double depth_along(const Vec3d& direction, const Body& a, const Body& b) {
  return direction.dot(support(a.shape, a.pose, direction)) -
         direction.dot(support(b.shape, b.pose, -direction));
}

struct PortalTally {
  int apart = 0, common = 0, least = 0, proven = 0, gave_up = 0;
};

// `truth`: signed distance; `margin`: metres.
void check(Precision scalar, const Body& a, const Body& b, double truth, double margin,
           PortalTally& tally) {
  const Outcome outcome = ask_named("mpr-refined", scalar, a, b);
  const Outcome plain = ask_named("mpr", scalar, a, b);
  (truth > 0 ? tally.apart : tally.common)++;
  if (std::abs(truth) > margin && outcome.status == Status::ok) {
    EXPECT_EQ(outcome.answer, truth > 0 ? Answer::separated : Answer::overlapping);
  }
  if (outcome.status != Status::ok) tally.gave_up++;
  if (outcome.answer != Answer::overlapping || truth > 0) return;
  EXPECT_LE(outcome.distance, truth + margin) << "less than the least";
  EXPECT_GE(outcome.distance, plain.distance - margin) << "more than mpr's";
  EXPECT_NEAR(outcome.normal.norm(), 1, 1e-6);
  EXPECT_LE(depth_along(outcome.normal, a, b), -outcome.distance + margin) << "does not separate";
  EXPECT_LE(outcome.lower, truth + margin);
  EXPECT_GE(outcome.upper, truth - margin);
  EXPECT_LE(outcome.upper, 0);
  const bool proven = outcome.upper - outcome.lower <= 10 * margin;
  const bool least = outcome.distance >= truth - margin;
  if (proven) {
    EXPECT_GE(outcome.distance, truth - 10 * margin);
  }
  tally.proven += proven;
  tally.least += least;
}

// Two random polytopes with their centres up to `spread` apart.
template <class MakeShape>
PortalTally sweep(Precision scalar, const MakeShape& make, int count, double spread,
                  double margin) {
  Random random(11);
  PortalTally tally;
  for (int k = 0; k < drawn(count, 100) && !testing::Test::HasFailure(); ++k) {
    const Body a{make(random), {random_rotation(random), random_direction(random)}};
    const Vec3d direction = random_direction(random);
    const Vec3d offset = std::cbrt(uniform(random, 0, 1)) * spread * direction;
    const Body b{make(random), {random_rotation(random), a.pose.translation + offset}};
    SCOPED_TRACE(k);
    check(scalar, a, b, brute_force::signed_distance(a.shape, a.pose, b.shape, b.pose), margin,
          tally);
  }
  return tally;
}

Shape any_box(Random& random) {
  return box(uniform(random, 0.2, 1), uniform(random, 0.2, 1), uniform(random, 0.2, 1));
}

class MprRefined : public testing::TestWithParam<Precision> {
 protected:
  double margin() const { return GetParam() == Precision::float64 ? 1e-12 : 2e-5; }
};

void expect_mostly_least(const PortalTally& tally) {
  EXPECT_GT(tally.apart, (tally.apart + tally.common) / 10);
  EXPECT_GT(tally.common, (tally.apart + tally.common) / 10);
  EXPECT_LE(tally.gave_up, (tally.apart + tally.common) / 100);
  EXPECT_GE(tally.least, tally.common * 3 / 4);
  EXPECT_GE(tally.proven, tally.common / 4);
  std::printf("%d common: %.1f %% least, %.1f %% proven\n", tally.common,
              100.0 * tally.least / tally.common, 100.0 * tally.proven / tally.common);
}

TEST_P(MprRefined, FindsTheLeastDepthOfMostBoxes) {
  expect_mostly_least(sweep(GetParam(), any_box, 1500, 1.8, margin()));
}
TEST_P(MprRefined, FindsTheLeastDepthOfMostHulls) {
  expect_mostly_least(sweep(GetParam(), any_hull, 400, 2.1, margin()));
}

// The ray from the centre passes a corner of the difference, the worst way out. From there no face
// is proven to hold the origin, so the search starts again beside it.
TEST_P(MprRefined, LeavesTheCorner) {
  const Body a{box(1, 1, 1), {}};
  for (const double shift : {0.1, 0.5, 1.9}) {
    const Body b{box(1, 1, 1), {Mat3d::Identity(), Vec3d(shift, shift, shift)}};
    for (const char* const name : {"mpr", "mpr-refined"}) {
      const Outcome outcome = ask_named(name, GetParam(), a, b);
      EXPECT_EQ(outcome.status, Status::ok) << name;
      EXPECT_NEAR(outcome.distance, shift - 2, margin()) << name;
    }
  }
}

// Flat, thin and pointed hulls, coincident centres, and sizes and places of 1e-6 to 1e6. Depths of
// bodies without volume are of the solid difference that they make together.
TEST_P(MprRefined, HoldsItsBoundsAtTheExtremes) {
  Random random(12);
  PortalTally tally;
  for (int k = 0; k < 400 && !HasFailure(); ++k) {
    const double size = std::pow(10.0, uniform(random, -6, 6));
    const auto draw = [&]() -> Shape {
      const double thin = std::pow(10.0, uniform(random, -4, 0));
      switch (random() % 3) {
        case 0: return box_as_hull(size, size * thin, size * thin);
        case 1: return box(size, size, size * thin);
        default: return box_as_hull(size, size, size * thin);
      }
    };
    const Vec3d place = size * random_vector(random, 0, 2);
    const bool coincident = random() % 4 == 0;
    const Body a{draw(), {random_rotation(random), place}};
    const Vec3d offset =
        coincident ? Vec3d::Zero().eval() : (size * random_vector(random, 0, 1.5)).eval();
    const Body b{draw(), {random_rotation(random), place + offset}};
    SCOPED_TRACE(k);
    const double truth = brute_force::signed_distance(a.shape, a.pose, b.shape, b.pose);
    check(GetParam(), a, b, truth, margin() * 10 * size, tally);
  }
  EXPECT_GT(tally.apart, 40);
  EXPECT_GT(tally.common, 40);
  EXPECT_LE(tally.gave_up, 20);
}

// Points, segments and flat sets: a depth of nothing, whatever is said of the verdict.
TEST_P(MprRefined, LivesWithBodiesWithoutVolume) {
  Random random(13);
  int common = 0, apart = 0;
  for (int k = 0; k < 300; ++k) {
    const auto draw = [&] {
      std::vector<Vec3d> points;
      const int dimension = static_cast<int>(random() % 3);
      const Vec3d u = random_direction(random), v = random_direction(random);
      for (int i = 0; i <= dimension; ++i) points.push_back((i == 1 ? u : v) - (i == 2 ? u : v));
      return bare_hull(points, dimension);
    };
    const Body a{draw(), {random_rotation(random), Vec3d::Zero()}};
    const Body b{k % 2 == 0 ? any_box(random) : draw(),
                 {random_rotation(random), random_vector(random, 0, 1)}};
    const Outcome outcome = ask_named("mpr-refined", GetParam(), a, b);
    const Outcome plain = ask_named("mpr", GetParam(), a, b);
    common += outcome.answer == Answer::overlapping;
    apart += outcome.answer == Answer::separated;
    EXPECT_EQ(outcome.answer, plain.answer);
    if (outcome.answer != Answer::overlapping) continue;
    EXPECT_GE(outcome.distance, plain.distance - margin());
    EXPECT_LE(depth_along(outcome.normal, a, b), -outcome.distance + margin());
    EXPECT_LE(outcome.lower, outcome.upper);
  }
  EXPECT_GT(common, 30);
  EXPECT_GT(apart, 30);
}

// Round bodies: against the exact answer.
TEST_P(MprRefined, HoldsItsBoundsForRoundBodies) {
  Random random(14);
  PortalTally tally;
  const double margin = GetParam() == Precision::float64 ? 1e-8 : 1e-4;
  for (int k = 0; k < 300 && !HasFailure(); ++k) {
    const auto draw = [&] {
      Shape shape;
      shape.kind = all_shape_kinds[random() % 6];
      shape.radius = uniform(random, 0.2, 0.6);
      shape.half_length = uniform(random, 0.2, 0.6);
      for (double& half : shape.half_extents) half = uniform(random, 0.2, 0.6);
      for (double& radius : shape.radii) radius = uniform(random, 0.2, 0.6);
      return shape;
    };
    const Body a{draw(), {random_rotation(random), Vec3d::Zero()}};
    const Body b{draw(), {random_rotation(random), random_vector(random, 0.1, 1.4)}};
    const double truth = ask_named("exact", Precision::float64, a, b).distance;
    SCOPED_TRACE(k);
    // The exact answer to this task has nothing but the verdict where they are apart.
    check(GetParam(), a, b, std::isnan(truth) ? 1 : truth, margin, tally);
  }
  EXPECT_GT(tally.apart, 60);
  EXPECT_GT(tally.common, 60);
  EXPECT_LE(tally.gave_up, 30);
  EXPECT_GE(tally.least, tally.common * 2 / 3);
}

// Bodies that move a little from frame to frame, through each other and apart, and now and then
// somewhere else.
TEST_P(MprRefined, IsNeverWorseWarm) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("mpr-refined");
  ASSERT_TRUE(entry.traits.starts_warm);
  Random random(15);
  int common = 0, apart = 0, better = 0;
  long calls_warm = 0, calls_cold = 0;
  for (int scene = 0; scene < 40 && !HasFailure(); ++scene) {
    const std::vector<Shape> shapes{any_hull(random), any_hull(random)};
    const std::array<std::uint32_t, 2> shape_of{0, 1};
    const std::array<std::uint32_t, 1> first{0}, second{1}, memory_of{0};
    std::vector<Pose> poses(2);
    poses[0].rotation = random_rotation(random);
    poses[1].rotation = random_rotation(random);
    const Vec3d from = random_direction(random);
    const Vec3d axis = random_direction(random);
    std::array<std::array<PairMemory, 1>, 2> memories{};
    const auto warm = entry.make(settings_of(GetParam()));
    const auto cold = entry.make(settings_of(GetParam()));
    warm->bind(shapes);
    cold->bind(shapes);
    for (int frame = 0; frame < 60; ++frame) {
      if (frame == 30) poses[1].rotation = random_rotation(random);
      poses[1].rotation = Eigen::AngleAxisd(0.01, axis).toRotationMatrix() * poses[1].rotation;
      poses[1].translation.setZero();
      const double touching = depth_along(from, {shapes[0], poses[0]}, {shapes[1], poses[1]});
      poses[1].translation = touching * (1 - 0.2 * std::sin(0.2 * frame)) * from;
      for (const Task task : {Task::penetration, Task::intersect}) {
        PairBatch batch{
            .kind_a = ShapeKind::hull,
            .kind_b = ShapeKind::hull,
            .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = poses}};
        std::array<Outcome, 1> of_cold, of_warm;
        cold->solve(task, batch, of_cold);
        batch.memory = memories[task == Task::intersect ? 0 : 1];
        batch.memory_of = memory_of;
        warm->solve(task, batch, of_warm);
        const Outcome &c = of_cold[0], &w = of_warm[0];
        SCOPED_TRACE(std::to_string(scene) + " " + std::to_string(frame));
        EXPECT_TRUE(w.answer == c.answer || c.answer == Answer::unknown);
        EXPECT_TRUE(w.status == c.status || w.status == Status::ok);
        if (task == Task::penetration) {
          calls_warm += w.support_calls;
          calls_cold += c.support_calls;
        }
        common += w.answer == Answer::overlapping;
        apart += w.answer == Answer::separated;
        if (std::isnan(c.distance)) continue;
        EXPECT_GE(w.distance, c.distance - margin()) << "deeper than from a cold start";
        better += w.distance > c.distance + margin();
        const Body a{shapes[0], poses[0]}, b{shapes[1], poses[1]};
        EXPECT_LE(depth_along(w.normal, a, b), -w.distance + margin());
        const double truth = brute_force::signed_distance(a.shape, a.pose, b.shape, b.pose);
        EXPECT_LE(w.distance, truth + margin());
        EXPECT_GE(w.upper, truth - margin());
      }
    }
  }
  EXPECT_GT(common, 500);
  EXPECT_GT(apart, 500);
  EXPECT_GT(better, 0);
  EXPECT_LT(calls_warm, calls_cold);
  std::printf("%ld support calls warm, %ld cold; better %d times\n", calls_warm, calls_cold,
              better);
}

INSTANTIATE_TEST_SUITE_P(Scalars, MprRefined,
                         testing::Values(Precision::float64, Precision::float32),
                         [](const auto& precision) {
                           return std::string(to_string(precision.param));
                         });

}  // namespace
}  // namespace touchstone::mpr_refined_test
