// Answers with a memory of the frames before are as right as cold ones, whatever happened between
// the frames, and less work where little did.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::warm_start_test {
namespace {

using namespace reference;

Shape ball_hull(Random& random, int points, double radius) {
  std::vector<Vec3d> vertices;
  for (int i = 0; i < points; ++i) vertices.push_back(radius * random.direction());
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = touchstone::make_hull(std::move(vertices));
  return shape;
}

Shape flat_hull(double size, std::vector<Vec3d> vertices) {
  for (Vec3d& vertex : vertices) vertex *= size;
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = touchstone::make_hull(std::move(vertices));
  return shape;
}

// Two bodies, kind_a <= kind_b, and what is known of them.
struct Pair {
  std::string name;
  std::vector<Shape> shapes;
  std::vector<Pose> poses = std::vector<Pose>(2);
  double size;  // metres, about
  PairMemory memory = {};
};

std::vector<Pair> pairs_of_all_sorts(Random& random) {
  std::vector<Pair> pairs;
  const auto add = [&](const std::string& name, double size, Shape a, Shape b) {
    if (a.kind > b.kind) std::swap(a, b);
    pairs.push_back({.name = name, .shapes = {std::move(a), std::move(b)}, .size = size});
  };
  const auto hull = [&](int points, double size) { return ball_hull(random, points, size); };
  for (const int points : {4, 8, 30, 250}) {
    add("hulls of " + std::to_string(points), 1, hull(points, 1), hull(points, 0.7));
  }
  add("boxes", 1, make_box(1, 0.6, 0.4), make_box(0.3, 0.9, 0.7));
  add("box and hull", 1, make_box(1, 0.6, 0.4), hull(20, 0.8));
  add("tiny", 1e-7, hull(12, 1e-7), make_box(1e-7, 0.6e-7, 0.4e-7));
  add("huge", 1e7, hull(12, 1e7), hull(8, 0.7e7));
  add("needle and plate", 1, make_box(1, 1e-3, 1e-3), make_box(0.8, 0.9, 1e-4));
  add("segment and hull", 1, flat_hull(1, {{0, 0, -1}, {0, 0, 1}}), hull(12, 0.8));
  add("triangle and box", 1, flat_hull(1, {{1, 0, 0}, {-1, 1, 0}, {0, -1, 0}}),
      make_box(0.5, 0.6, 0.4));
  add("point and box", 1, flat_hull(1, {{0, 0, 0}}), make_box(0.5, 0.6, 0.4));
  add("box of no size and hull", 1, make_box(0, 0, 0), hull(12, 0.8));
  add("spheres", 1, make_sphere(0.8), make_sphere(0.5));
  add("capsule and box", 1, make_capsule(0.3, 0.7), make_box(0.5, 0.6, 0.4));
  add("capsules", 1, make_capsule(0.3, 0.7), make_capsule(0.5, 0.4));
  add("cylinder and hull", 1, make_cylinder(0.6, 0.7), hull(12, 0.8));
  add("cone and box", 1, make_cone(0.6, 0.7), make_box(0.5, 0.6, 0.4));
  add("ellipsoids", 1, make_ellipsoid(1, 0.6, 0.4), make_ellipsoid(0.3, 0.9, 0.7));
  add("sphere and cone", 1, make_sphere(0.4), make_cone(0.6, 0.7));
  return pairs;
}

void turn(Pose& pose, const Vec3d& axis, double angle) {
  pose.rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * pose.rotation;
}

// A little motion; and now and then a jump to anywhere, from far apart to deep inside, or a turn by
// any angle on the spot.
void move(Random& random, int frame, Pair& pair) {
  Pose& b = pair.poses[1];
  const double size = pair.size;
  if (frame % 9 == 0) {
    const double reach = std::pow(10, random.uniform(-2, 0.7)) * size;
    b.translation = pair.poses[0].translation + reach * random.direction();
  } else if (frame % 9 == 4) {
    b.rotation = random.rotation();
  } else if (frame % 9 == 7) {
    b.translation = pair.poses[0].translation + 0.1 * (frame % 2) * size * random.direction() +
                    (1 - frame % 2) * 2 * size * random.direction();
  } else {
    b.translation += random.vector(0.02 * size);
    turn(b, random.direction(), 0.03);
    turn(pair.poses[0], random.direction(), 0.02);
  }
}

Outcome ask(NarrowPhase& algorithm, Task task, const Pair& pair, PairMemory* memory) {
  const std::array<std::uint32_t, 2> shape_of{0, 1};
  const std::array<std::uint32_t, 1> first{0}, second{1}, slot{0};
  std::array<Outcome, 1> outcomes;
  PairBatch batch{
      .kind_a = pair.shapes[0].kind,
      .kind_b = pair.shapes[1].kind,
      .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = pair.poses}};
  if (memory != nullptr) {
    batch.memory = {memory, 1};
    batch.memory_of = slot;
  }
  algorithm.solve(task, batch, outcomes);
  return outcomes[0];
}

struct Tally {
  int asked = 0, separated = 0, overlapping = 0, failed_cold = 0, failed_warm = 0;
};

// `any_depth`: of some translation that separates, not the least.
void grade(const Outcome& outcome, const oracle::Measure& truth, Task task, bool any_depth,
           double size, double error, const std::string& what) {
  if (outcome.status != Status::ok || std::abs(truth.middle()) < error * size) return;
  const bool apart = truth.middle() > 0;
  EXPECT_EQ(outcome.answer, apart ? Answer::separated : Answer::overlapping) << what;
  if (!asks_for_number(task, outcome.answer)) return;
  if (any_depth) {
    EXPECT_LE(outcome.distance, truth.middle() + error * size) << what;
  } else {
    EXPECT_NEAR(outcome.distance, truth.middle(), error * size) << what;
  }
  EXPECT_LE(outcome.lower, truth.upper + error * 1e-2 * size) << what;
  EXPECT_GE(outcome.upper, truth.lower - error * 1e-2 * size) << what;
  const double along = outcome.normal.dot(outcome.witness_b - outcome.witness_a) - outcome.distance;
  EXPECT_NEAR(along, 0, 2 * error * size) << what;
}

Tally play(const NarrowPhaseEntry& entry, Precision scalar, Task task,
           const std::function<void(Random&, PairMemory&)>& disturb) {
  Random random(static_cast<unsigned>(task) + 1);
  oracle::Oracle oracle;
  Tally tally;
  const double error = scalar == Precision::float64 ? 1e-8 : 2e-4;
  auto pairs = pairs_of_all_sorts(random);
  std::erase_if(pairs, [&](const Pair& pair) {
    return !offers(entry, pair.shapes[0].kind, pair.shapes[1].kind, task);
  });
  // Of one or two pairs all frames are few enough, and fewer would not show both answers.
  const int frames = pairs.size() > 2 ? drawn(30, 15) : 30;
  for (Pair& pair : pairs) {
    const auto cold = entry.make({.scalar = scalar});
    const auto warm = entry.make({.scalar = scalar});
    cold->bind(pair.shapes);
    warm->bind(pair.shapes);
    const oracle::Solid a(pair.shapes[0]), b(pair.shapes[1]);
    for (int frame = 0; frame < frames; ++frame) {
      move(random, frame, pair);
      disturb(random, pair.memory);
      const std::string what = pair.name + ", frame " + std::to_string(frame);
      const oracle::Measure truth = oracle.measure({a, pair.poses[0]}, {b, pair.poses[1]});
      const Outcome of_cold = ask(*cold, task, pair, nullptr);
      const Outcome of_warm = ask(*warm, task, pair, &pair.memory);
      grade(of_cold, truth, task, entry.traits.depth_is_bound, 4 * pair.size, error,
            "cold, " + what);
      grade(of_warm, truth, task, entry.traits.depth_is_bound, 4 * pair.size, error,
            "warm, " + what);
      ++tally.asked;
      tally.failed_cold += of_cold.status != Status::ok;
      tally.failed_warm += of_warm.status != Status::ok;
      tally.separated += of_warm.answer == Answer::separated;
      tally.overlapping += of_warm.answer == Answer::overlapping;
    }
  }
  return tally;
}

std::vector<const NarrowPhaseEntry*> warm_ones() {
  std::vector<const NarrowPhaseEntry*> entries;
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (entry.traits.starts_warm && is_built(entry.info)) entries.push_back(&entry);
  }
  return entries;
}

void expect_right(const std::function<void(Random&, PairMemory&)>& disturb) {
  for (const NarrowPhaseEntry* entry : warm_ones()) {
    for (const Precision scalar : entry->scalars) {
      for (const Task task : entry->tasks) {
        SCOPED_TRACE(entry->info.name + " " + std::string(to_string(scalar)) + " " +
                     std::string(to_string(task)));
        const Tally tally = play(*entry, scalar, task, disturb);
        EXPECT_GT(tally.separated, tally.asked / 12);
        EXPECT_GT(tally.overlapping, tally.asked / 12);
        EXPECT_LE(tally.failed_warm, tally.failed_cold + 3);
      }
    }
  }
}

TEST(WarmStart, IsKnownToSome) {
  std::vector<std::string> names;
  for (const NarrowPhaseEntry* entry : warm_ones()) names.push_back(entry->info.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"gjk", "gjk-lanes", "ellipsoid", "smooth", "sat"}));
}

TEST(WarmStart, IsAsRightAsAColdOneThroughMotionAndJumps) {
  expect_right([](Random&, PairMemory&) {});
}

// More than the contract asks for: nothing that can be in memory is believed.
TEST(WarmStart, WhateverIsInMemory) {
  expect_right([](Random& random, PairMemory& memory) {
    std::array<std::uint32_t, 16> words;
    for (std::uint32_t& word : words) {
      const float real = static_cast<float>(random.uniform(-1, 1));
      word = random.below(2) ? static_cast<std::uint32_t>(random.below(9))
                             : std::bit_cast<std::uint32_t>(real);
    }
    if (random.below(3) == 0) words[0] = static_cast<std::uint32_t>(random.below(5));
    if (random.below(9) == 0) {
      words[static_cast<std::size_t>(random.below(16))] = random.below(2) ? 0x7fc00000 : ~0u;
    }
    std::memcpy(memory.bytes.data(), words.data(), sizeof words);
  });
}

// One memory serves every task.
TEST(WarmStart, TasksMayTakeTurns) {
  const NarrowPhaseEntry& gjk = *registry::find<NarrowPhaseEntry>("gjk");
  Random random(11);
  oracle::Oracle oracle;
  for (Pair& pair : pairs_of_all_sorts(random)) {
    const auto warm = gjk.make({});
    warm->bind(pair.shapes);
    const oracle::Solid a(pair.shapes[0]), b(pair.shapes[1]);
    for (int frame = 0; frame < 40; ++frame) {
      move(random, frame, pair);
      const oracle::Measure truth = oracle.measure({a, pair.poses[0]}, {b, pair.poses[1]});
      const Task task = gjk.tasks[static_cast<std::size_t>(random.below(3))];
      grade(ask(*warm, task, pair, &pair.memory), truth, task, false, 4 * pair.size, 1e-8,
            pair.name);
    }
  }
}

// The work for pairs that move a little each frame.
struct Work {
  std::int64_t iterations = 0, support_calls = 0, answers[2] = {};
};

Work work_of(const char* name, Task task, bool warm, double distance, int points) {
  const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>(name);
  Random random(21);
  Work work;
  for (int n = 0; n < 30; ++n) {
    Pair pair{.name = "",
              .shapes = {ball_hull(random, points, 1), ball_hull(random, points, 1)},
              .size = 1};
    pair.poses[0].rotation = random.rotation();
    pair.poses[1].translation = distance * random.direction();
    const auto algorithm = entry.make({});
    algorithm->bind(pair.shapes);
    const Vec3d axis = random.direction(), way = random.vector(0.002);
    for (int frame = 0; frame < 40; ++frame) {
      turn(pair.poses[1], axis, 0.004);
      pair.poses[1].translation += way;
      const Outcome outcome = ask(*algorithm, task, pair, warm ? &pair.memory : nullptr);
      work.iterations += outcome.iterations;
      work.support_calls += outcome.support_calls;
      work.answers[outcome.answer == Answer::overlapping] += 1;
    }
  }
  return work;
}

TEST(WarmStart, IsLessWorkWhereLittleMoves) {
  for (const int points : {8, 60, 300}) {
    const Work cold = work_of("gjk", Task::distance, false, 2.4, points);
    const Work warm = work_of("gjk", Task::distance, true, 2.4, points);
    EXPECT_GT(warm.answers[0], 1000);
    EXPECT_LT(3 * warm.iterations, cold.iterations) << points;
    EXPECT_LT(3 * warm.support_calls, cold.support_calls) << points;
  }
  const Work near = work_of("gjk", Task::intersect, false, 1.9, 60);
  const Work near_warm = work_of("gjk", Task::intersect, true, 1.9, 60);
  EXPECT_GT(near_warm.answers[0], 100);
  EXPECT_GT(near_warm.answers[1], 100);
  EXPECT_LT(2 * near_warm.support_calls, near.support_calls);
  const Work deep = work_of("gjk", Task::intersect, false, 0.8, 60);
  const Work deep_warm = work_of("gjk", Task::intersect, true, 0.8, 60);
  EXPECT_GT(deep_warm.answers[1], 1000);
  EXPECT_LT(10 * deep_warm.support_calls, deep.support_calls);
  const Work axes = work_of("sat", Task::intersect, false, 1.95, 20);
  const Work axes_warm = work_of("sat", Task::intersect, true, 1.95, 20);
  EXPECT_EQ(axes.answers[0], axes_warm.answers[0]);
  EXPECT_GT(axes_warm.answers[0], 600);
  EXPECT_LT(axes_warm.iterations, axes.iterations);
}

}  // namespace
}  // namespace touchstone::warm_start_test
