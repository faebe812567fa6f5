// Distances against the oracle's.
#include <gtest/gtest.h>

#include "algorithms/core/isa.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/families/triangle_pairs.h"
#include "tests/algorithms/concave/agreed.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using reference::Answered;
using reference::ask;
using reference::body_of;
using reference::moved_by;

// Expects bounds that enclose the oracle's distance and are not further apart than `width`; returns
// true if the bodies are apart.
bool measures(const std::array<ConcaveBody, 2>& bodies, const Pose& a, const Pose& b,
              double width) {
  const Outcome truth = ask("exact", ConcaveTask::distance, bodies, a, b).outcome;
  for (const char* name : {"fused", "part-pairs"}) {
    SCOPED_TRACE(name);
    const Outcome found = ask(name, ConcaveTask::distance, bodies, a, b).outcome;
    EXPECT_EQ(found.answer, truth.answer);
    EXPECT_EQ(found.status, Status::ok);
    if (truth.answer != Answer::separated) {
      EXPECT_TRUE(std::isnan(found.distance));
      continue;
    }
    EXPECT_LE(found.lower, truth.upper);
    EXPECT_GE(found.upper, truth.lower);
    EXPECT_LE(found.upper - found.lower, width + 1e-9 * truth.upper);
    EXPECT_NEAR(found.distance, truth.distance, width + 1e-9 * truth.upper);
    EXPECT_NEAR((found.witness_a - found.witness_b).norm(), truth.distance,
                width + 1e-9 * truth.upper);
  }
  return truth.answer == Answer::separated;
}

TEST(ConcaveDistance, OfTori) {
  families::RandomDraws random(1);
  const std::array<ConcaveBody, 2> bodies = {body_of(reference::torus(10, 5, 1, 0.2)),
                                             body_of(reference::torus(8, 4, 0.8, 0.2))};
  int apart = 0;
  const int count = drawn(12, 2);
  for (int i = 0; i < count; ++i) {
    const Pose a = {random.rotation(), random.vector(1)}, b = {random.rotation(), random.vector(1)};
    apart += measures(bodies, a, b, 1e-13);
  }
  if (one_in == 1) {
    EXPECT_GT(apart, 2);
    EXPECT_LT(apart, count);
  }
}

TEST(ConcaveDistance, IsTheSameAtEveryLevelOfInstructions) {
  families::RandomDraws random(3);
  const std::array<ConcaveBody, 2> bodies = {body_of(reference::torus(20, 10, 1, 0.2)),
                                             body_of(reference::torus(16, 8, 0.8, 0.2))};
  int apart = 0;
  const int count = drawn(20, 4);
  for (int i = 0; i < count; ++i) {
    const Pose a = {random.rotation(), random.vector(1)},
               b = {random.rotation(), random.vector(1) + Vec3d(1.5, 0, 0)};
    const Outcome best = ask("fused", ConcaveTask::distance, bodies, a, b).outcome;
    if (best.answer != Answer::separated) continue;
    ++apart;
    for (const Isa level : isa_levels()) {
      SCOPED_TRACE(to_string(level));
      limit_isa(level);
      const Outcome found = ask("fused", ConcaveTask::distance, bodies, a, b).outcome;
      EXPECT_EQ(found.lower, best.lower);
      EXPECT_EQ(found.upper, best.upper);
      EXPECT_EQ(found.witness_a, best.witness_a);
      EXPECT_EQ(found.witness_b, best.witness_b);
    }
    limit_isa(isa_of_machine());
  }
  EXPECT_GT(apart, 0);
}

TEST(ConcaveDistance, OfTrianglesOfEveryFamily) {
  families::RandomDraws random(2);
  int apart = 0, met = 0;
  for (const auto& family : families::triangle_families()) {
    SCOPED_TRACE(family.name);
    for (const families::TriangleForm form : families::all_triangle_forms) {
      for (int i = 0; i < drawn(11, 1); ++i) {
        const families::TrianglePair pair = in_form(family.draw(random), form, random);
        const double size = form == families::TriangleForm::far_away ? 4e6 : 4;
        ++(measures({reference::mesh_of({pair.a}), reference::mesh_of({pair.b})}, pair.pose_a,
                    pair.pose_b, 1e-12 * size)
               ? apart
               : met);
      }
    }
  }
  EXPECT_GT(apart, 100 / one_in);
  EXPECT_GT(met, 100 / one_in);
}

TEST(ConcaveDistance, OfMeshesAndConvexParts) {
  families::RandomDraws random(3);
  const ConcaveBody torus = body_of(reference::torus(10, 5, 1, 0.2));
  ConcaveBody pair = body_of(reference::make_capsule(0.2, 0.3), moved_by({0.5, 0, 0}));
  pair.parts.push_back({reference::make_box(0.25, 0.25, 0.25), moved_by({-0.5, 0, 0}), 0});
  int apart = 0;
  const int count = drawn(12, 3);
  for (int i = 0; i < count; ++i) {
    const Pose a = {random.rotation(), random.vector(1)}, b = moved_by(random.vector(1));
    apart += measures({torus, pair}, a, b, 1e-11);
    apart += measures({pair, body_of(reference::make_sphere(0.5))}, b, a, 1e-11);
  }
  EXPECT_GT(apart, 2);
}

// Boxes of half-spaces have no end, along axes or along any other way.
TEST(ConcaveDistance, OfHalfSpaces) {
  Shape floor;
  floor.kind = ShapeKind::halfspace;
  const ConcaveBody torus = body_of(reference::torus(10, 5, 1, 0.25));
  ConcaveBody ends = body_of(reference::make_sphere(0.25), moved_by({3, 0, 0}));
  ends.parts.push_back({floor, moved_by({0, 0, -2}), 0});
  families::RandomDraws random(4);
  for (int i = 0; i < drawn(12, 3); ++i) {
    const Pose a = {random.rotation(), {0, 0, random.uniform(-0.7, 0.7)}};
    EXPECT_TRUE(measures({torus, body_of(floor)}, a, moved_by({7, 7, -2}), 1e-11));
    EXPECT_TRUE(measures({ends, torus}, {}, a, 1e-11));
    const Mat3d turned = i % 2 == 0 ? Mat3d::Identity() : random.rotation();
    const Vec3d down = turned * Vec3d(0, 0, -3);
    EXPECT_TRUE(measures({torus, body_of(floor)}, a, {turned, down}, 1e-11));
  }
}

TEST(ConcaveDistance, OfAnEmptyBodyIsNotKnown) {
  const ConcaveBody none = body_of(TriangleMesh{});
  const ConcaveBody ball = body_of(reference::make_sphere(1));
  for (const char* name : {"fused", "part-pairs", "exact"}) {
    const Outcome found = ask(name, ConcaveTask::distance, {none, ball}, {}, {}).outcome;
    EXPECT_EQ(found.answer, Answer::separated);
    EXPECT_TRUE(std::isnan(found.distance));
  }
}

// Lengths are those of the world, whatever the rotations do, and beyond the range of floats.
TEST(ConcaveDistance, OfStretchedAndHugeBodies) {
  Pose wide;
  wide.rotation *= 3;
  EXPECT_TRUE(
      measures({body_of(reference::box_mesh(1, 1, 1)), body_of(reference::box_mesh(1, 1, 1))}, wide,
               moved_by({5, 0, 0}), 1e-13));
  for (const double size : {1e-30, 1e25, 1e45}) {
    SCOPED_TRACE(size);
    const ConcaveBody box = body_of(reference::box_mesh(size, size, size));
    EXPECT_TRUE(measures({box, box}, {}, moved_by({5 * size, size, 4 * size}), 1e-13 * size));
  }
}

// Whose squares doubles do not hold: what is not known is not said to be.
TEST(ConcaveDistance, BeyondTheRangeOfSquares) {
  for (const double size : {1e-156, 1e-170, 1e160, 1e200}) {
    SCOPED_TRACE(size);
    const ConcaveBody box = body_of(reference::box_mesh(size, size, size));
    for (const char* name : {"fused", "part-pairs"}) {
      const Outcome found =
          ask(name, ConcaveTask::distance, {box, box}, {}, moved_by({3 * size, 0, 0})).outcome;
      EXPECT_EQ(found.answer, Answer::separated);
      EXPECT_NE(found.status, Status::ok);
      if (!std::isnan(found.upper)) {
        EXPECT_LE(found.lower, size);
        EXPECT_GE(found.upper, size * (1 - 1e-9));
      }
    }
  }
}

// A coarse narrow phase is enough for a coarse tolerance, and for no finer one.
TEST(ConcaveDistance, WithinATolerance) {
  const std::array<ConcaveBody, 2> bodies = {body_of(reference::make_ellipsoid(1, 2, 3)),
                                             body_of(reference::make_cylinder(0.5, 1))};
  ConcaveSettings settings = reference::concave_settings();
  settings.narrow_phase = [] {
    return registry::find<NarrowPhaseEntry>("certified")->make({.tolerance = 0.01});
  };
  const auto measured = [&](std::optional<double> tolerance) {
    settings.tolerance = tolerance;
    const auto phase = registry::find<ConcaveEntry>("fused")->make(settings);
    phase->bind(bodies);
    Outcome outcome;
    std::vector<IndexPair> pairs;
    phase->solve(ConcaveTask::distance, {0, {}}, {1, moved_by({4, 1, 0.5})}, outcome, pairs);
    EXPECT_LT(outcome.lower, outcome.upper);
    return outcome.status;
  };
  EXPECT_EQ(measured(0.01), Status::ok);
  EXPECT_EQ(measured({}), Status::not_converged);
}

}  // namespace
}  // namespace touchstone
