// One pair at a time against the oracle: at every distance, size and number of digits.
#include "algorithms/narrow_phase/closed_form/plain_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algorithms/narrow_phase/closed_form/plain_box_depth.h"
#include "algorithms/narrow_phase/closed_form/plain_boxes.h"
#include "algorithms/narrow_phase/closed_form/plain_capsule_box.h"
#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::plain_pair_test {
namespace {

using reference::make_box;
using reference::make_capsule;
using reference::make_cone;
using reference::make_cylinder;
using reference::make_sphere;
using reference::Random;

// Lengths from nothing to a thousand.
double length(Random& random) {
  return random.below(12) == 0 ? 0 : std::pow(10.0, random.uniform(-3, 3));
}
Shape shape_of(ShapeKind kind, Random& random) {
  switch (kind) {
    case ShapeKind::sphere: return make_sphere(length(random));
    case ShapeKind::capsule: return make_capsule(length(random), length(random));
    case ShapeKind::cylinder: return make_cylinder(length(random), length(random));
    case ShapeKind::cone: return make_cone(length(random), length(random));
    default: return make_box(length(random), length(random), length(random));
  }
}

// A rotation, or nearly one: files and integrators leave matrices that are a little skewed.
Mat3d turn(Random& random) {
  Mat3d matrix = random.below(4) == 0 ? Mat3d(Mat3d::Identity()) : random.rotation();
  if (random.below(3) == 0) {
    const double skew = std::pow(10.0, random.uniform(-16, -2));
    for (int k = 0; k < 3; ++k) matrix.col(k) += skew * random.direction();
  }
  return matrix;
}

struct Posed {
  Shape shape;
  Pose pose;
};
struct Pair {
  Posed a, b;
};

// A pair at a distance that is drawn from 1e-17 to 1 of its size, on both sides of contact.
Pair pair_of(ShapeKind kind_a, ShapeKind kind_b, Random& random, oracle::Oracle& oracle) {
  Pair pair{{shape_of(kind_a, random), {turn(random), random.vector(1)}},
            {shape_of(kind_b, random), {turn(random), random.vector(1)}}};
  const oracle::Solid a(pair.a.shape), b(pair.b.shape);
  const oracle::Measure measure = oracle.measure({a, pair.a.pose}, {b, pair.b.pose});
  const double size = std::abs(measure.middle()) + 1e-3;
  const double wanted =
      size * std::pow(10.0, random.uniform(-17, 0)) * (random.below(2) == 0 ? 1 : -1);
  pair.b.pose.translation += (wanted - measure.middle()) * measure.normal;
  return pair;
}

// The sum of all lengths of a pair.
double size_of(const Pair& pair) {
  const auto extent = [](const Posed& body) {
    return body.shape.radius + body.shape.half_length + body.shape.half_extents.sum();
  };
  return (pair.b.pose.translation - pair.a.pose.translation).lpNorm<1>() + extent(pair.a) +
         extent(pair.b);
}

// Answers a pair whose kinds have a form of their own.
bool solve(Task task, const Pair& pair, Outcome& outcome) {
  const auto& [a, b] = pair;
  if (a.shape.kind == ShapeKind::box)
    return solve_plain_box_depth(a.shape, a.pose, b.shape, b.pose, outcome);
  const bool capsule_box = a.shape.kind == ShapeKind::capsule && b.shape.kind == ShapeKind::box;
  const auto function = capsule_box ? plain_capsule_box() : solve_plain_pair;
  return function(task, a.shape, a.pose, b.shape, b.pose, outcome,
                  std::numeric_limits<double>::infinity());
}

struct Count {
  int separated = 0, overlapping = 0, open = 0, open_but_clear = 0;
};

void expect_outcome(const Pair& pair, Task task, oracle::Oracle& oracle, Count& count) {
  const oracle::Solid a(pair.a.shape), b(pair.b.shape);
  const oracle::Body body_a(a, pair.a.pose), body_b(b, pair.b.pose);
  const oracle::Measure measure = oracle.measure(body_a, body_b);
  Outcome outcome;
  if (!solve(task, pair, outcome)) {
    EXPECT_EQ(outcome.status, Status::unsupported);  // as it was
    ++count.open;
    count.open_but_clear +=
        task == Task::intersect && std::abs(measure.middle()) > 1e-13 * size_of(pair);
    return;
  }
  ASSERT_EQ(outcome.status, Status::ok);
  ASSERT_EQ(outcome.answer, measure.answer);
  const bool apart = outcome.answer == Answer::separated;
  ++(apart ? count.separated : count.overlapping);
  if (!asks_for_number(task, outcome.answer)) {
    EXPECT_TRUE(std::isnan(outcome.distance));
    return;
  }
  EXPECT_LE(outcome.lower, measure.upper);
  EXPECT_GE(outcome.upper, measure.lower);
  const bool by_all_axes =
      pair.a.shape.kind != ShapeKind::sphere && pair.b.shape.kind == ShapeKind::box;
  EXPECT_LE(outcome.upper - outcome.lower, (by_all_axes ? 7e-14 : 4e-14) * size_of(pair));
  EXPECT_GE(outcome.distance, outcome.lower);
  EXPECT_LE(outcome.distance, outcome.upper);
  EXPECT_NEAR(outcome.normal.norm(), 1, 1e-14);
  const double far = pair.a.pose.translation.norm() + size_of(pair);
  EXPECT_LE((outcome.witness_b - outcome.witness_a - outcome.distance * outcome.normal).norm(),
            1e-13 * far);
  // The bodies are as far apart along the normal as they are.
  const oracle::Enclosure along = oracle::separation_along(body_a, body_b, outcome.normal);
  EXPECT_NEAR(along.upper, -measure.middle(), 1e-11 * size_of(pair));
}

TEST(PlainPair, IsRightAtEveryDistance) {
  Random random(1);
  oracle::Oracle oracle;
  for (const auto& [kind_a, kind_b] : {std::pair{ShapeKind::sphere, ShapeKind::sphere},
                                       {ShapeKind::sphere, ShapeKind::capsule},
                                       {ShapeKind::sphere, ShapeKind::box},
                                       {ShapeKind::sphere, ShapeKind::cylinder},
                                       {ShapeKind::sphere, ShapeKind::cone},
                                       {ShapeKind::capsule, ShapeKind::capsule},
                                       {ShapeKind::capsule, ShapeKind::box}}) {
    for (const Task task : all_tasks) {
      SCOPED_TRACE(testing::Message()
                   << to_string(kind_a) << " " << to_string(kind_b) << " " << to_string(task));
      Count count;
      const int pairs = 4000 / one_in;
      for (int k = 0; k < pairs; ++k)
        expect_outcome(pair_of(kind_a, kind_b, random, oracle), task, oracle, count);
      EXPECT_GT(count.separated, pairs / 8);
      EXPECT_GT(count.overlapping, pairs / 10);
      EXPECT_GT(count.open, pairs / 100);
      // A plane across the shortest connection of the axes does not part a skewed solid as well.
      EXPECT_LT(count.open_but_clear, kind_b >= ShapeKind::box ? pairs / 10 : pairs / 50);
    }
  }
}

TEST(PlainBoxDepth, IsRightAtEveryDepth) {
  Random random(3);
  oracle::Oracle oracle;
  Count count;
  const int pairs = 10'000 / one_in;
  for (int k = 0; k < pairs; ++k) {
    Pair pair = pair_of(ShapeKind::box, ShapeKind::box, random, oracle);
    // Boxes on a table have parallel faces; a small turn makes edges nearly parallel.
    if (k % 4 == 0) pair.b.pose.rotation = pair.a.pose.rotation;
    if (k % 8 == 0) {
      const double angle = std::pow(10.0, random.uniform(-17, -2));
      const Vec3d axis = k % 16 == 0 ? Vec3d(Vec3d::UnitZ()) : random.direction();
      pair.b.pose.rotation *= Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    }
    expect_outcome(pair, Task::penetration, oracle, count);
  }
  EXPECT_EQ(count.separated, 0);
  EXPECT_GT(count.overlapping, pairs / 8);
  EXPECT_GT(count.open, pairs / 4);
}

TEST(PlainPair, LeavesWhatOverflowsOrCoincidesOpen) {
  Outcome outcome;
  const Pose here;
  for (const double scale : {1e-320, 1e-200, 1e200, 1e308}) {
    const Pose there{Mat3d::Identity(), Vec3d(3 * scale, 0, 0)};
    const Shape a = make_sphere(scale), b = make_capsule(scale, scale);
    EXPECT_FALSE(solve_plain_pair(Task::intersect, a, here, b, there, outcome)) << scale;
    EXPECT_FALSE(solve_plain_pair(Task::distance, b, here, b, there, outcome)) << scale;
  }
  const Shape ball = make_sphere(1), point = make_sphere(0);
  EXPECT_FALSE(solve_plain_pair(Task::penetration, ball, here, ball, here, outcome));
  EXPECT_FALSE(solve_plain_pair(Task::intersect, point, here, point, here, outcome));
  const Shape box = make_box(1, 1, 1);
  EXPECT_FALSE(solve_plain_pair(Task::intersect, box, here, box, here, outcome));
  EXPECT_FALSE(solve_plain_pair(Task::intersect, make_capsule(1, 1), here, box, here, outcome));
}

TEST(PlainBoxes, AreRightAtEveryDistance) {
  Random random(2);
  oracle::Oracle oracle;
  Count count;
  const int pairs = 20'000 / one_in;
  for (int k = 0; k < pairs; ++k) {
    Pair pair = pair_of(ShapeKind::box, ShapeKind::box, random, oracle);
    // Boxes on a table have parallel edges.
    if (k % 4 == 0) pair.b.pose.rotation = pair.a.pose.rotation;
    const PlainBoxes boxes = plain_boxes();
    Answer answer = boxes.in_float(pair.a.shape, pair.a.pose, pair.b.shape, pair.b.pose);
    count.open_but_clear += answer == Answer::unknown;
    if (answer == Answer::unknown)
      answer = boxes.in_double(pair.a.shape, pair.a.pose, pair.b.shape, pair.b.pose);
    const oracle::Solid a(pair.a.shape), b(pair.b.shape);
    const Answer right = oracle.verdict({a, pair.a.pose}, {b, pair.b.pose});
    if (answer == Answer::unknown) {
      ++count.open;
      continue;
    }
    ASSERT_EQ(answer, right) << k;
    ++(answer == Answer::separated ? count.separated : count.overlapping);
  }
  EXPECT_GT(count.separated, pairs / 4);
  EXPECT_GT(count.overlapping, pairs / 10);
  EXPECT_GT(count.open_but_clear, pairs / 10);  // to double
}

}  // namespace
}  // namespace touchstone::plain_pair_test
