// Compounds, convex bodies and solids: every phase against the oracle, and against narrow phases.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/kernels/triangles/winding.h"
#include "algorithms/oracle/concave/exact_winding.h"
#include "tests/algorithms/concave/agreed.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::agreed;
using reference::Answered;
using reference::ask;
using reference::body_of;
using reference::moved_by;

Shape any_shape(reference::Random& random) {
  switch (random.below(7)) {
    case 0: return reference::make_sphere(0.3);
    case 1: return reference::make_capsule(0.2, 0.3);
    case 2: return reference::make_box(0.2, 0.3, 0.4);
    case 3: return reference::make_cylinder(0.2, 0.3);
    case 4: return reference::make_cone(0.3, 0.3);
    case 5: return reference::make_ellipsoid(0.2, 0.3, 0.4);
    default: break;
  }
  std::vector<Vec3d> points;
  for (int i = 0; i < 8; ++i) points.push_back(random.vector(0.4));
  return hull_of(std::move(points));
}

// Parts that are moved only, so that nothing is rounded.
ConcaveBody any_compound(reference::Random& random, int parts) {
  ConcaveBody body;
  for (int i = 0; i < parts; ++i) {
    const Vec3d place(random.below(9) / 4.0 - 1, random.below(9) / 4.0 - 1,
                      random.below(9) / 4.0 - 1);
    body.parts.push_back({any_shape(random), moved_by(place), 0});
  }
  return body;
}

TEST(ConcaveBodies, CompoundsAgainstAnything) {
  reference::Random random(1);
  const ConcaveBody mesh = body_of(reference::torus(8, 5, 1, 0.3));
  int hits = 0, open = 0;
  const int count = drawn(60, 30);
  for (int i = 0; i < count; ++i) {
    const ConcaveBody first = any_compound(random, 3);
    const ConcaveBody second = i % 3 == 0 ? mesh : any_compound(random, i % 3 == 1 ? 1 : 4);
    const Pose a = moved_by({random.below(9) / 4.0, random.below(9) / 4.0, 0});
    const Pose b = {i % 3 == 1 ? Mat3d::Identity() : random.rotation(), {0, 0, 0.125}};
    const Answered answered =
        i % 2 == 0 ? agreed({first, second}, a, b) : agreed({second, first}, b, a);
    hits += answered.meets();
    open += answered.outcome.answer == Answer::unknown;
  }
  EXPECT_GT(hits, count / 10);
  EXPECT_LT(hits, count);
  EXPECT_LE(open, count / 10);
}

// Two convex bodies: the narrow phase's verdict.
TEST(ConcaveBodies, ConvexBodiesAreCompoundsOfOnePart) {
  reference::Random random(2);
  int hits = 0;
  const int count = drawn(60, 30);
  for (int i = 0; i < count; ++i) {
    const Pose a = {random.rotation(), random.vector(0.4)}, b = {random.rotation(), {0, 0, 0}};
    hits += agreed({body_of(any_shape(random)), body_of(any_shape(random))}, a, b).meets();
  }
  EXPECT_GT(hits, count / 4);
  EXPECT_LT(hits, count);
}

TEST(ConcaveBodies, HalfSpaces) {
  Shape floor;
  floor.kind = ShapeKind::halfspace;
  const std::array<ConcaveBody, 2> bodies = {body_of(reference::torus(8, 5, 1, 0.3)),
                                             body_of(floor)};
  EXPECT_EQ(agreed(bodies, {}, moved_by({0, 0, -1})).pairs.size(), 0u);
  EXPECT_EQ(agreed(bodies, {}, moved_by({0, 0, 1})).pairs.size(), 80u);
  const Answered half = agreed(bodies, {}, moved_by({5, 5, 0.1}));
  EXPECT_GT(half.pairs.size(), 0u);
  EXPECT_LT(half.pairs.size(), 80u);
}

// A part that is turned within a turned body: where it touches but for rounding, nobody says so.
TEST(ConcaveBodies, RoundedPartsAreDecidedAwayFromContactAlone) {
  reference::Random random(3);
  ConcaveBody turned;
  turned.parts.push_back({reference::make_box(1, 1, 1), {random.rotation(), {0.1, 0.2, 0.3}}, 0});
  const ConcaveBody box = body_of(reference::make_box(1, 1, 1));
  // The other box has the same place, up to rounding, and is moved along an axis of it.
  const Pose body = {random.rotation(), {0.3, 0.2, 0.1}};
  Pose same = {body.rotation * turned.parts[0].pose.rotation,
               body(turned.parts[0].pose.translation)};
  const Vec3d center = same.translation, axis = same.rotation.col(0);
  same.translation = center + 2 * axis;
  const Answered touch = agreed({turned, box}, body, same);
  EXPECT_EQ(touch.outcome.answer, Answer::unknown);
  EXPECT_EQ(touch.outcome.status, Status::degenerate);
  same.translation = center + (2 - 1e-9) * axis;
  EXPECT_TRUE(agreed({turned, box}, body, same).meets());
  same.translation = center + (2 + 1e-9) * axis;
  EXPECT_EQ(agreed({turned, box}, body, same).outcome.answer, Answer::separated);
}

// Turned parts of all kinds near contact: rounded poses hide no verdict, and make none wrong.
TEST(ConcaveBodies, TurnedPartsOfTurnedBodiesNearContact) {
  reference::Random random(6);
  const ConcaveBody triangle =
      reference::mesh_of({{Vec3d(0, 0, 0), Vec3d(2, 0, 0), Vec3d(0, 2, 0)}});
  int hits = 0, misses = 0;
  const int count = drawn(80, 16);
  for (int i = 0; i < count; ++i) {
    ConcaveBody turned, other;
    turned.parts.push_back({any_shape(random), {random.rotation(), random.vector(0.5)}, 0});
    other.parts.push_back({any_shape(random), {random.rotation(), random.vector(0.5)}, 0});
    const std::array<ConcaveBody, 2> bodies = {turned, i % 3 == 0 ? triangle : other};
    const Pose a = {random.rotation(), random.vector(1)};
    Pose b = {random.rotation(), a.translation};
    const Vec3d start = b.translation, way = random.direction();
    double in = 0, out = 8;
    for (int step = 0; step < 30; ++step) {
      const double middle = (in + out) / 2;
      b.translation = start + middle * way;
      (ask("part-pairs", ConcaveTask::intersect, bodies, a, b).meets() ? in : out) = middle;
    }
    for (const double off : {-1e-2, -1e-7, 1e-7, 1e-2}) {
      b.translation = start + ((in + out) / 2 + off) * way;
      const Answered answered = agreed(bodies, a, b);
      hits += answered.meets();
      misses += answered.outcome.answer == Answer::separated;
    }
  }
  EXPECT_GT(hits, count);
  EXPECT_GT(misses, count);
}

TEST(ConcaveBodies, WhatIsInsideOfASolidMeetsIt) {
  const TriangleMesh small = reference::box_mesh(0.25, 0.25, 0.25);
  reference::Random random(4);
  const Pose turned = {random.rotation(), random.vector(2)};
  for (const bool solid : {false, true}) {
    const ConcaveBody large = body_of(reference::box_mesh(1, 1, 1, solid));
    for (const ConcaveBody& inner : {body_of(small), body_of(reference::make_sphere(0.5)),
                                     body_of(reference::make_box(0.5, 0.25, 0.25))}) {
      for (const Pose& pose : {Pose{}, turned}) {
        const Answered answered = agreed({large, inner}, pose, pose);
        EXPECT_EQ(answered.meets(), solid);
        EXPECT_TRUE(answered.pairs.empty());
        EXPECT_EQ(agreed({inner, large}, pose, pose).meets(), solid);
        EXPECT_FALSE(agreed({large, inner}, pose, moved_by({9, 9, 9})).meets());
      }
    }
  }
}

TEST(ConcaveBodies, TheHoleOfASolidTorusIsOutside) {
  const ConcaveBody torus = body_of(reference::torus(16, 8, 1, 0.3, true));
  const ConcaveBody ball = body_of(reference::make_sphere(0.1));
  EXPECT_FALSE(agreed({torus, ball}, {}, {}).meets());
  EXPECT_TRUE(agreed({torus, ball}, {}, moved_by({1, 0, 0})).meets());
  EXPECT_TRUE(agreed({torus, ball}, {}, moved_by({0, -1, 0})).meets());
  EXPECT_FALSE(agreed({torus, ball}, {}, moved_by({0, 0, 0.5})).meets());
  // One of two pieces is inside.
  TriangleMesh pieces = reference::box_mesh(0.05, 0.05, 0.05);
  const TriangleMesh other = pieces;
  for (const Vec3d& vertex : other.vertices) pieces.vertices.push_back(vertex + Vec3d(1, 0, 0));
  for (const auto& t : other.triangles) pieces.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  EXPECT_TRUE(agreed({torus, body_of(pieces)}, {}, {}).meets());
  EXPECT_TRUE(agreed({body_of(pieces), torus}, {}, {}).meets());
  EXPECT_FALSE(agreed({body_of(pieces), torus}, {}, moved_by({0, 0, 1})).meets());
  // A surface with its inside out winds too, and one that winds back has a hollow.
  TriangleMesh hollow = reference::box_mesh(1, 1, 1, true),
               cavity = reference::box_mesh(0.75, 0.75, 0.75);
  for (const Vec3d& vertex : cavity.vertices) hollow.vertices.push_back(vertex);
  for (const auto& t : cavity.triangles) {
    hollow.triangles.push_back({t[0] + 8, t[2] + 8, t[1] + 8});
  }
  EXPECT_FALSE(agreed({body_of(hollow), ball}, {}, {}).meets());
  EXPECT_TRUE(agreed({body_of(hollow), ball}, {}, moved_by({0.87, 0, 0})).meets());
}

// Points that share coordinates with vertices, and lie over edges, as the ray sees them.
TEST(ConcaveBodies, WindingNumbers) {
  reference::Random random(5);
  int inside = 0, asked = 0;
  for (int i = 0; i < drawn(600, 60); ++i) {
    const TriangleMesh mesh =
        i % 2 == 0 ? reference::box_mesh(1, 1, 1, true) : reference::torus(8, 4, 1, 0.5, true);
    const auto quarter = [&] { return random.below(13) / 4.0 - 1.5; };
    const Vec3d grid(quarter(), quarter(), quarter());
    const Vec3d corner = mesh.vertices[random.below(static_cast<int>(mesh.vertices.size()))];
    const Vec3d point = i % 3 == 0 ? grid : Vec3d(corner[0] / 2, corner[1], corner[2]);
    const Pose pose = i % 5 == 0 ? Pose{random.rotation(), random.vector(2)} : Pose{};
    TriangleMesh surface = mesh;
    surface.solid = false;
    const bool on_surface =
        ask("exact", ConcaveTask::intersect, {body_of(surface), body_of(reference::make_sphere(0))},
            {}, moved_by(point))
            .meets();
    if (on_surface) continue;
    const int turns = winding_number(mesh, pose, point, pose, 2);
    EXPECT_EQ(turns, oracle::exact_winding(mesh, pose, point, pose));
    if (i % 2 == 0) {
      EXPECT_EQ(turns, point.cwiseAbs().maxCoeff() < 1 ? 1 : 0);
    }
    ++asked;
    inside += turns != 0;
  }
  EXPECT_GT(inside, asked / 20);
  EXPECT_LT(inside, asked);
}

}  // namespace
}  // namespace touchstone
