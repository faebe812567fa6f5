// Contacts of a mesh that heed the triangles around: none points across an edge inside of a flat surface, and what
// the surface supports stays as it is.
#include <gtest/gtest.h>

#include <algorithm>

#include "algorithms/core/bounds.h"
#include "algorithms/hull/convex_hull.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::body_of;
using reference::mesh_of;
using reference::moved_by;

std::vector<PartContact> contacts_of(const char* name, bool welds,
                                     const std::array<ConcaveBody, 2>& bodies, const Pose& a,
                                     const Pose& b) {
  ConcaveSettings settings = reference::concave_settings();
  settings.welds = welds;
  const auto phase = registry::find<ConcaveEntry>(name)->make(settings);
  phase->bind(bodies);
  Outcome outcome;
  std::vector<IndexPair> pairs;
  phase->solve(ConcaveTask::contacts, {0, a}, {1, b}, outcome, pairs);
  std::vector<PartContact> contacts;
  EXPECT_TRUE(phase->measure({0, a}, {1, b}, pairs, contacts));
  return contacts;
}

// Squares of two triangles each on [-1, 1] x [-1, 1], at height(x, y).
template <class Height>
ConcaveBody ground(int cells, const Height& height) {
  std::vector<std::array<Vec3d, 3>> triangles;
  const auto at = [&](int i, int j) {
    const double x = 2.0 * i / cells - 1, y = 2.0 * j / cells - 1;
    return Vec3d(x, y, height(x, y));
  };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh_of(triangles);
}

Shape any_body(reference::Random& random, int kind) {
  std::vector<Vec3d> points;
  for (int k = 0; k < 12; ++k) points.push_back(0.3 * random.direction());
  return kind == 0   ? reference::make_sphere(0.3)
         : kind == 1 ? reference::make_capsule(0.2, 0.2)
         : kind == 2 ? reference::make_box(0.3, 0.2, 0.25)
                     : hull_of(points);
}

TEST(Welding, NoNormalOfAFlatGroundLeansAside) {
  reference::Random random(1);
  const ConcaveBody flat = ground(8, [](double, double) { return 0.0; });
  int alone = 0, mended = 0;
  for (int i = 0; i < drawn(40, 8); ++i) {
    const Shape shape = any_body(random, i % 4);
    const Pose a = {random.rotation(), random.vector(1)};
    const Vec3d up = a.rotation.col(2);
    Pose b = {random.rotation(), Vec3d::Zero()};
    const double depth = 0.01, below = -up.dot(support_point(shape, b, -up));
    b.translation =
        a(Vec3d(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0)) + (below - depth) * up;
    const bool first = i % 3 != 0;
    const std::array<ConcaveBody, 2> bodies =
        first ? std::array{flat, body_of(shape)} : std::array{body_of(shape), flat};
    const Vec3d out = first ? up : Vec3d(-up);
    const char* name = i % 2 == 0 ? "fused" : "part-pairs";
    const Pose &pose_a = first ? a : b, &pose_b = first ? b : a;
    const auto leans = [&](const PartContact& contact) {
      return contact.normal.dot(out) < 1 - 1e-9;
    };
    alone += static_cast<int>(
        std::ranges::count_if(contacts_of(name, false, bodies, pose_a, pose_b), leans));
    double deepest = 0;
    for (const PartContact& contact : contacts_of(name, true, bodies, pose_a, pose_b)) {
      EXPECT_EQ(contact.status, Status::ok);
      EXPECT_FALSE(leans(contact)) << i;
      deepest = std::max(deepest, contact.depth);
      mended += contact.is_welded;
    }
    EXPECT_NEAR(deepest, depth, 1e-9) << i;
  }
  EXPECT_GT(alone, 0);
  EXPECT_GT(mended, 0);
}

// Of a ball that reaches over the ridge of a roof, or over the rim of the ground.
TEST(Welding, WhatTheSurfaceSupportsIsKept) {
  const ConcaveBody roof = ground(4, [](double x, double) { return -std::abs(x); });
  const ConcaveBody ball = body_of(reference::make_sphere(0.3));
  for (const auto& [x, z] : {std::pair(0.0, 0.29), std::pair(1.25, -0.85)}) {
    const auto contacts = contacts_of("fused", true, {roof, ball}, {}, moved_by({x, 0.1, z}));
    EXPECT_FALSE(contacts.empty());
    for (const PartContact& contact : contacts) {
      EXPECT_FALSE(contact.is_welded);
      const Vec3d from(x > 0 ? 1 : 0, 0.1, x > 0 ? -1 : 0);
      EXPECT_LT((contact.normal - (Vec3d(x, 0.1, z) - from).normalized()).norm(), 1e-6);
    }
  }
}

// A ball on the ground of a ditch that touches the edge to a gentle slope: alone, the slope would push it by the way
// from the edge, which the ground is in the way of.
TEST(Welding, TheSlopeOfADitchPushesAlongItsFace) {
  const ConcaveBody ditch = ground(4, [](double x, double) { return std::max(0.0, 0.1 * x); });
  const ConcaveBody ball = body_of(reference::make_sphere(0.3));
  const Pose at = moved_by({-0.05, 0.1, 0.295});
  const Vec3d of_slope = Vec3d(-0.1, 0, 1).normalized();
  int welded = 0;
  for (const PartContact& contact : contacts_of("fused", true, {ditch, ball}, {}, at)) {
    const bool is_up = contact.normal.z() > 1 - 1e-9;
    EXPECT_NEAR(contact.depth, is_up ? 0.005 : 0.3 - of_slope.dot(at.translation), 1e-12);
    EXPECT_LT((contact.normal - (is_up ? Vec3d::UnitZ() : of_slope)).norm(), 1e-9);
    welded += contact.is_welded && !is_up;
  }
  EXPECT_GT(welded, 0);
}

// A ball that lies on a box near its rim: also the triangles of the side give it the normal of the top.
TEST(Welding, TheRimOfABoxPushesUp) {
  std::vector<std::array<Vec3d, 3>> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3d out = Vec3d::Zero(), u = Vec3d::Zero(), v = Vec3d::Zero();
      out[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1;
      triangles.push_back({out - u - v, out + u - v, out + u + v});
      triangles.push_back({out - u - v, out + u + v, out - u + v});
    }
  }
  const ConcaveBody box = mesh_of(triangles);
  int welded = 0;
  for (const double x : {0.7, 0.9, 0.99}) {
    const Pose at = moved_by({x, 0.2, 1.4});
    const ConcaveBody ball = body_of(reference::make_sphere(0.5));
    for (const PartContact& contact : contacts_of("fused", true, {box, ball}, {}, at)) {
      EXPECT_LT((contact.normal - Vec3d::UnitZ()).norm(), 1e-9) << x;
      EXPECT_NEAR(contact.depth, 0.1, 1e-9) << x;
      welded += contact.is_welded;
    }
  }
  EXPECT_GT(welded, 0);
}

}  // namespace
}  // namespace touchstone
