// Ellipsoids against the oracle's enclosures, in shapes and places where smooth methods go wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/narrow_phase/bodies.h"

namespace touchstone::ellipsoid_test {
namespace {

using namespace test;

struct Pair {
  Shape a, b;
  Pose pose_a, pose_b;
};

Shape ellipsoid(const Vec3d& radii) {
  Shape shape;
  shape.kind = ShapeKind::ellipsoid;
  shape.radii = radii;
  return shape;
}

Shape random_ellipsoid(Random& random, double aspect) {
  const auto radius = [&] { return 0.5 * std::pow(aspect, uniform(random, -1, 0)); };
  return ellipsoid({radius(), radius(), radius()});
}

// The results of many pairs of one sort.
struct EllipsoidTally {
  int pairs = 0, overlapping = 0, gave_up = 0;
  double worst = 0;  // error of a distance or depth that was `ok`, as a part of the size
};

double size_of(const Shape& shape) { return std::max(shape.radius, shape.radii.maxCoeff()); }

// Every task of both scalars, each against the enclosure; what is `ok` has to be right.
EllipsoidTally check(Precision scalar, int count, unsigned seed,
                     const std::function<Pair(Random&)>& draw) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>("ellipsoid");
  const double accuracy = scalar == Precision::float64 ? 1e-12 : 1e-5;
  oracle::Oracle oracle;
  Random random(seed);
  EllipsoidTally tally;
  for (int k = 0; k < count; ++k) {
    const Pair pair = draw(random);
    const oracle::Solid solid_a(pair.a), solid_b(pair.b);
    const oracle::Body body_a(solid_a, pair.pose_a), body_b(solid_b, pair.pose_b);
    const oracle::Measure truth = oracle.measure(body_a, body_b);
    const double size = std::max({size_of(pair.a), size_of(pair.b),
                                  (pair.pose_b.translation - pair.pose_a.translation).norm()});
    tally.overlapping += truth.upper < 0 ? 1 : 0;
    for (const Task task : all_tasks) {
      SCOPED_TRACE(std::to_string(k) + " " + std::string(to_string(task)));
      const Outcome outcome =
          ask(entry, settings_of(scalar), task, pair.a, pair.pose_a, pair.b, pair.pose_b);
      ++tally.pairs;
      tally.gave_up += outcome.status == Status::ok ? 0 : 1;
      const double margin = accuracy * size;
      if (outcome.answer == Answer::separated) {
        EXPECT_GT(truth.upper, -margin);
      } else if (outcome.answer == Answer::overlapping) {
        EXPECT_LT(truth.lower, margin);
      } else {
        EXPECT_EQ(outcome.answer, Answer::unknown);
        EXPECT_NE(outcome.status, Status::ok);
      }
      if (!asks_for_number(task, outcome.answer)) {
        EXPECT_TRUE(std::isnan(outcome.distance));
        continue;
      }
      // The bounds hold whatever the status is.
      EXPECT_LE(outcome.lower, truth.upper + margin);
      EXPECT_GE(outcome.upper, truth.lower - margin);
      if (outcome.status != Status::ok) continue;
      const double error =
          std::max(outcome.distance - truth.upper, truth.lower - outcome.distance) / size;
      tally.worst = std::max(tally.worst, error);
      EXPECT_LE(error, accuracy);
      EXPECT_NEAR(outcome.normal.norm(), 1, 1e-6);
      const Vec3d between = outcome.witness_b - outcome.witness_a;
      const double far = std::max({1.0, pair.pose_a.translation.norm() / size});
      EXPECT_LE((between - outcome.distance * outcome.normal).norm(),
                (scalar == Precision::float64 ? 1e-9 : 3e-5) * size + 1e-15 * far * size);
    }
    if (testing::Test::HasFailure()) break;
  }
  std::printf("%d asked, %d pairs overlap, %d gave up, worst error %.1e\n", tally.pairs,
              tally.overlapping, tally.gave_up, tally.worst);
  return tally;
}

class EllipsoidPairs : public testing::TestWithParam<Precision> {
 protected:
  // Expects that both answers occur, and that all but `percent` per cent are `ok`.
  void expect_good(int count, unsigned seed, int percent,
                   const std::function<Pair(Random&)>& draw) const {
    const EllipsoidTally tally = check(GetParam(), count, seed, draw);
    EXPECT_LE(tally.gave_up * 100, tally.pairs * percent);
    EXPECT_GE(tally.overlapping, count / 5);
    EXPECT_LE(tally.overlapping, count * 4 / 5);
  }
  bool is_double() const { return GetParam() == Precision::float64; }
};

Pair place(Random& random, const Shape& a, const Shape& b, double near, double far) {
  Pair pair{a, b, {random_rotation(random), Vec3d::Zero()}, {random_rotation(random), {}}};
  pair.pose_a.translation = random_direction(random);
  pair.pose_b.translation = pair.pose_a.translation + random_vector(random, near, far);
  return pair;
}

Shape ball_or_ellipsoid(Random& random, double aspect) {
  return random() % 3 == 0 ? sphere(uniform(random, 0.1, 0.5)) : random_ellipsoid(random, aspect);
}

TEST_P(EllipsoidPairs, AtRandom) {
  expect_good(300, 1, 0, [](Random& random) {
    return place(random, ball_or_ellipsoid(random, 4), random_ellipsoid(random, 4), 0, 1.2);
  });
}

// Aspects to 1e4 (double) or 1e2.
TEST_P(EllipsoidPairs, Thin) {
  const double aspect = is_double() ? 1e4 : 1e2;
  expect_good(300, 2, 10, [&](Random& random) {
    return place(random, ball_or_ellipsoid(random, aspect), random_ellipsoid(random, aspect), 0,
                 0.6);
  });
}

TEST_P(EllipsoidPairs, DeepAndConcentric) {
  const EllipsoidTally tally = check(GetParam(), 200, 3, [](Random& random) {
    const Shape a = ball_or_ellipsoid(random, 4), b = random_ellipsoid(random, 4);
    return place(random, a, b, 0, random() % 2 == 0 ? 0 : 0.05);
  });
  EXPECT_LE(tally.gave_up, tally.pairs / 100);
}

// One body and itself, turned alike, with all, two or one of its radii equal.
TEST_P(EllipsoidPairs, Equal) {
  expect_good(150, 4, 2, [](Random& random) {
    Shape a = random_ellipsoid(random, 3);
    const auto kind = random() % 3;
    if (kind > 0) a.radii.y() = a.radii.x();
    if (kind > 1) a.radii.z() = a.radii.x();
    Pair pair = place(random, a, a, 0, random() % 4 == 0 ? 0 : 1.5);
    pair.pose_b.rotation = pair.pose_a.rotation;
    return pair;
  });
}

TEST_P(EllipsoidPairs, OfEveryScale) {
  expect_good(200, 5, 0, [](Random& random) {
    Pair pair = place(random, ball_or_ellipsoid(random, 4), random_ellipsoid(random, 4), 0.1, 1.2);
    const double scale = std::pow(10.0, uniform(random, -6, 6));
    for (Shape* shape : {&pair.a, &pair.b}) {
      shape->radius *= scale;
      shape->radii *= scale;
    }
    pair.pose_a.translation *= scale;
    pair.pose_b.translation *= scale;
    return pair;
  });
}

TEST_P(EllipsoidPairs, FarFromTheOrigin) {
  expect_good(200, 6, 1, [](Random& random) {
    Pair pair = place(random, ball_or_ellipsoid(random, 4), random_ellipsoid(random, 4), 0.1, 1.2);
    const Vec3d away = 1e7 * random_direction(random);
    pair.pose_a.translation += away;
    pair.pose_b.translation += away;
    return pair;
  });
}

// Gaps and depths from a tenth down to rounding: the normals of both agree where they meet.
TEST_P(EllipsoidPairs, Touching) {
  const double finest = is_double() ? -13 : -4.5;
  expect_good(300, 7, 2, [&](Random& random) {
    Pair pair = place(random, ball_or_ellipsoid(random, 4), random_ellipsoid(random, 4), 0, 0);
    const Vec3d n = random_direction(random);
    const double gap =
        (random() % 2 == 0 ? 1 : -1) * 0.1 * std::pow(10.0, uniform(random, finest + 1, 0));
    pair.pose_b.translation +=
        support(pair.a, pair.pose_a, n) - support(pair.b, pair.pose_b, -n) + gap * n;
    return pair;
  });
}

// Matrices that are not rotations are used as they stand.
TEST_P(EllipsoidPairs, Sheared) {
  expect_good(200, 8, 1, [](Random& random) {
    Pair pair = place(random, ball_or_ellipsoid(random, 2), random_ellipsoid(random, 2), 0.1, 1.2);
    if (pair.a.kind != ShapeKind::sphere) {
      pair.pose_a.rotation *= Vec3d(uniform(random, 0.5, 1.5), 1, -0.8).asDiagonal();
    }
    pair.pose_b.rotation += 0.2 * random_rotation(random);
    return pair;
  });
}

// No volume: whatever is said has to be right, but little need be said.
TEST_P(EllipsoidPairs, Flat) {
  check(GetParam(), 300, 9, [](Random& random) {
    Shape a = ball_or_ellipsoid(random, 3), b = random_ellipsoid(random, 3);
    const auto flatten = [&](Shape& shape) {
      for (double& radius : shape.radii) {
        if (random() % 3 == 0) radius = 0;
      }
    };
    flatten(b);
    if (random() % 2 == 0) flatten(a);
    if (random() % 8 == 0) a.radius = 0;
    return place(random, a, b, 0, 0.8);
  });
}

INSTANTIATE_TEST_SUITE_P(Scalars, EllipsoidPairs,
                         testing::Values(Precision::float32, Precision::float64),
                         [](const testing::TestParamInfo<Precision>& scalar) {
                           return std::string(to_string(scalar.param));
                         });

}  // namespace
}  // namespace touchstone::ellipsoid_test
