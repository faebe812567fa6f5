// An instance that is bound again, to other and fewer bodies, answers as a new one does.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/registry.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using reference::Random;

std::vector<ConcaveBody> some_bodies(Random& random, int count) {
  std::vector<ConcaveBody> bodies;
  for (int i = 0; i < count; ++i) {
    const double size = random.uniform(0.5, 1.5);
    bodies.push_back(i % 3 == 2 ? reference::body_of(reference::make_box(size, size / 2, size))
                                : reference::body_of(families::box_mesh(size, size / 2, size)));
  }
  return bodies;
}

struct Asked {
  Outcome outcome;
  std::vector<IndexPair> pairs;
};

Asked ask(ConcavePhase& phase, ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b) {
  Asked asked;
  phase.solve(task, a, b, asked.outcome, asked.pairs);
  std::ranges::sort(asked.pairs);
  return asked;
}

TEST(BoundAgain, ConcavePhases) {
  Random random(4);
  const auto many = some_bodies(random, 30), few = some_bodies(random, 3);
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (!is_built(entry.info)) continue;
    SCOPED_TRACE(entry.info.name);
    const ConcaveSettings settings = {
        .mid_phase = registry::find<MidPhaseEntry>("wide-bvh")->make,
        .narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); }};
    const auto again = entry.make(settings), fresh = entry.make(settings);
    again->bind(many);
    // An algorithm may prepare more when it is first asked.
    for (std::uint32_t i = 0; i + 1 < many.size(); ++i) {
      if (entry.supports != nullptr && !entry.supports(many[i], many[i + 1])) continue;
      ask(*again, ConcaveTask::intersect, {i, {}}, {i + 1, reference::moved_by({1, 0.25, 0})});
    }
    again->bind(few);
    fresh->bind(few);
    for (std::uint32_t i = 0; i < few.size(); ++i) {
      for (std::uint32_t k = 0; k < few.size(); ++k) {
        if (i == k || (entry.supports != nullptr && !entry.supports(few[i], few[k]))) continue;
        for (const ConcaveTask task : {ConcaveTask::intersect, ConcaveTask::contacts}) {
          if (!offers(entry, task, Precision::float64)) continue;
          const PlacedConcave a{i, {random.rotation(), Vec3d::Zero()}},
              b{k, reference::moved_by({1, 0.5, 0.25})};
          const Asked one = ask(*again, task, a, b), other = ask(*fresh, task, a, b);
          EXPECT_EQ(one.outcome.answer, other.outcome.answer);
          EXPECT_EQ(one.outcome.status, other.outcome.status);
          EXPECT_EQ(one.pairs, other.pairs);
        }
      }
    }
  }
}

TEST(BoundAgain, NarrowPhases) {
  const std::vector<Shape> many(20, reference::make_box(3, 2, 1)),
      few = {reference::make_box(1, 2, 3), reference::make_box(0.5, 0.5, 0.5)};
  const std::vector<std::uint32_t> first = {0}, second = {1}, shape_of = {0, 1};
  const std::vector<Pose> poses = {{}, reference::moved_by({1.25, 0, 0})};
  const PairBatch batch = {
      .kind_a = ShapeKind::box,
      .kind_b = ShapeKind::box,
      .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = poses}};
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (!is_built(entry.info)) continue;
    if (!offers(entry, ShapeKind::box, ShapeKind::box, Task::intersect)) continue;
    SCOPED_TRACE(entry.info.name);
    const Precision scalar =
        offers(entry, Precision::float64) ? Precision::float64 : Precision::float32;
    const auto again = entry.make({.scalar = scalar}), fresh = entry.make({.scalar = scalar});
    Outcome one, other;
    again->bind(many);
    again->solve(Task::intersect, batch, {&one, 1});
    again->bind(few);
    fresh->bind(few);
    again->solve(Task::intersect, batch, {&one, 1});
    fresh->solve(Task::intersect, batch, {&other, 1});
    EXPECT_EQ(one.answer, other.answer);
    EXPECT_EQ(one.status, other.status);
  }
}

// Of a mesh with more triangles, and then one with fewer.
TEST(BoundAgain, RayCastsAndPointQueries) {
  const TriangleMesh many = families::torus(20, 20, 3, 1), few = families::box_mesh(1, 1, 1);
  const Ray ray{{0.25, 0.125, 5}, {0, 0, -1}, HUGE_VAL};
  const Vec3d point(0.25, 0.125, 3);
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    if (!is_built(entry.info)) continue;
    SCOPED_TRACE(entry.info.name);
    const auto cast = entry.make(
        {.scalar = offers(entry, Precision::float64) ? Precision::float64 : Precision::float32});
    RayHit hit;
    cast->bind(many);
    cast->cast(RayTask::closest, {&ray, 1}, {&hit, 1});
    cast->bind(few);
    cast->cast(RayTask::closest, {&ray, 1}, {&hit, 1});
    EXPECT_TRUE(hit.hit);
    EXPECT_NEAR(hit.t, 4, 1e-5);
  }
  for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
    if (!is_built(entry.info)) continue;
    SCOPED_TRACE(entry.info.name);
    const auto query = entry.make();
    PointAnswer answer;
    query->bind(many);
    query->query(PointTask::closest, {&point, 1}, {&answer, 1});
    query->bind(few);
    query->query(PointTask::closest, {&point, 1}, {&answer, 1});
    EXPECT_NEAR(answer.distance, 2, 1e-5);
  }
}

}  // namespace
}  // namespace touchstone
