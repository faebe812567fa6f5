// Contact manifolds of pairs whose points are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/registry.h"
#include "harness/base/reproducible_math.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::reference {
namespace {

struct Body {
  Shape shape;
  Pose pose;
};

Body at(Shape shape, const Vec3d& place, const Mat3d& turn = Mat3d::Identity()) {
  return {std::move(shape), {turn, place}};
}

Mat3d turned(double angle, const Vec3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

Shape hull_of_box(double x, double y, double z) {
  std::vector<Vec3d> corners;
  for (int k = 0; k < 8; ++k) {
    corners.emplace_back((k & 1) != 0 ? x : -x, (k & 2) != 0 ? y : -y, (k & 4) != 0 ? z : -z);
  }
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = touchstone::make_hull(corners);
  return shape;
}

// Of a pair with kind_a <= kind_b, with checks that hold for every answer.
Manifold manifold_of(const Body& a, const Body& b, Precision scalar = Precision::float64) {
  const ManifoldEntry* const entry = registry::find<ManifoldEntry>("clipped-faces");
  EXPECT_TRUE(offers(*entry, a.shape.kind, b.shape.kind));
  const std::array shapes = {a.shape, b.shape};
  const std::array poses = {a.pose, b.pose};
  constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
  const PairBatch batch = {.kind_a = a.shape.kind,
                           .kind_b = b.shape.kind,
                           .pairs = {.first = std::span(bodies).first(1),
                                     .second = std::span(bodies).last(1),
                                     .shape_of = bodies,
                                     .poses = poses}};
  Manifold manifold;
  manifold.count = 3;  // is written over
  const auto algorithm = entry->make({.scalar = scalar});
  algorithm->bind(shapes);
  algorithm->solve(batch, {&manifold, 1});
  for (const ContactPoint& point : manifold.contacts()) {
    EXPECT_GE(point.depth, 0);
    EXPECT_TRUE(point.on_a.allFinite() && point.on_b.allFinite());
  }
  if (manifold.answer == Answer::separated) {
    EXPECT_EQ(manifold.count, 0);
  } else if (manifold.answer == Answer::overlapping) {
    EXPECT_GE(manifold.count, 1);
    EXPECT_NEAR(manifold.normal.norm(), 1, scalar == Precision::float64 ? 1e-15 : 5e-7);
  }
  return manifold;
}

// The points on b in some order.
void expect_points(const Manifold& manifold, const std::vector<Vec3d>& expected,
                   double tolerance = 1e-14) {
  ASSERT_EQ(static_cast<std::size_t>(manifold.count), expected.size());
  for (const Vec3d& point : expected) {
    EXPECT_TRUE(std::ranges::any_of(manifold.contacts(), [&](const ContactPoint& contact) {
      return (contact.on_b - point).norm() <= tolerance;
    })) << point.transpose();
  }
}

double deepest(const Manifold& manifold) {
  double depth = -1;
  for (const ContactPoint& point : manifold.contacts()) depth = std::max(depth, point.depth);
  return depth;
}

TEST(ClippedFaces, CubeOnCubeHasTheFourCornersOfTheLesserFace) {
  const Manifold manifold =
      manifold_of(at(make_box(2, 2, 1), {0, 0, 0}), at(make_box(1, 1, 1), {0.5, 0, 1.75}));
  EXPECT_EQ(manifold.answer, Answer::overlapping);
  EXPECT_EQ(manifold.status, Status::ok);
  EXPECT_EQ(manifold.normal, Vec3d(0, 0, 1));
  expect_points(manifold, {{-0.5, -1, 0.75}, {1.5, -1, 0.75}, {-0.5, 1, 0.75}, {1.5, 1, 0.75}});
  for (const ContactPoint& point : manifold.contacts()) {
    EXPECT_NEAR(point.depth, 0.25, 1e-15);
    EXPECT_NEAR(point.on_a.z(), 1, 1e-15);
  }
}

TEST(ClippedFaces, EqualFacesAreNotCutToPieces) {
  // Exactly on each other, and off by what rounding makes of it.
  for (const double off : {0.0, 1e-16, -1e-16, 1e-15, -3e-15}) {
    for (const bool hull : {false, true}) {
      const Shape shape = hull ? hull_of_box(1, 1, 1) : make_box(1, 1, 1);
      const Manifold manifold =
          manifold_of(at(make_box(1, 1, 1), {0, 0, 0}),
                      at(shape, {off, -off, 2 - 1e-3}, turned(off, {0, 0, 1})));
      const double low = 1 - 1e-3;
      expect_points(manifold, {{-1, -1, low}, {1, -1, low}, {-1, 1, low}, {1, 1, low}}, 1e-13);
    }
  }
}

TEST(ClippedFaces, IdenticalBodies) {
  for (const Shape& shape : {make_box(1, 2, 3), hull_of_box(1, 2, 3)}) {
    const Manifold manifold = manifold_of(at(shape, {5, 5, 5}), at(shape, {5, 5, 5}));
    EXPECT_EQ(manifold.count, 4);
    EXPECT_NEAR(deepest(manifold), 2, 1e-14);
    EXPECT_NEAR(std::abs(manifold.normal.x()), 1, 1e-14);
  }
}

TEST(ClippedFaces, ExactlyTouchingFacesHavePointsWithoutDepth) {
  for (const Shape& shape : {make_box(1, 1, 1), hull_of_box(1, 1, 1)}) {
    const Manifold manifold =
        manifold_of(at(make_box(1, 1, 1), {0, 0, 0}), at(shape, {0.5, 0.5, 2}));
    EXPECT_EQ(manifold.answer, Answer::touching);
    EXPECT_EQ(manifold.status, Status::ok);
    expect_points(manifold, {{-0.5, -0.5, 1}, {1, -0.5, 1}, {-0.5, 1, 1}, {1, 1, 1}}, 1e-13);
    EXPECT_LE(deepest(manifold), 1e-13);
  }
}

TEST(ClippedFaces, CrossedEdgesHaveOnePoint) {
  // Two cubes on edge, one turned by a quarter: the edges cross at the middle.
  const Mat3d edge_down = turned(std::numbers::pi / 4, {1, 0, 0});
  const Mat3d crossed = turned(std::numbers::pi / 2, {0, 0, 1}) * edge_down;
  const double high = 2 * std::numbers::sqrt2 - 0.01;
  for (const bool hull : {false, true}) {
    const Shape shape = hull ? hull_of_box(1, 1, 1) : make_box(1, 1, 1);
    const Manifold manifold =
        manifold_of(at(make_box(1, 1, 1), {0, 0, 0}, edge_down), at(shape, {0, 0, high}, crossed));
    expect_points(manifold, {{0, 0, std::numbers::sqrt2 - 0.01}}, 1e-12);
    EXPECT_NEAR(deepest(manifold), 0.01, 1e-14);
  }
}

TEST(ClippedFaces, AnEdgeOnAFaceHasTwoPointsAndACornerOne) {
  const Body ground = at(make_box(5, 5, 1), {0, 0, -1});
  const Mat3d edge_down = turned(std::numbers::pi / 4, {1, 0, 0});
  const double half = std::numbers::sqrt2;
  for (const bool hull : {false, true}) {
    const Shape shape = hull ? hull_of_box(1, 1, 1) : make_box(1, 1, 1);
    expect_points(manifold_of(ground, at(shape, {0, 0, half - 0.1}, edge_down)),
                  {{-1, 0, -0.1}, {1, 0, -0.1}}, 1e-13);
    const Mat3d corner_down = base::rotation_between({1, 1, 1}, {0, 0, -1});
    expect_points(manifold_of(ground, at(shape, {0, 0, std::sqrt(3.0) - 0.1}, corner_down)),
                  {{0, 0, -0.1}}, 1e-13);
  }
}

TEST(ClippedFaces, TiltedFaceEndsWhereItLeavesTheOther) {
  const double tilt = 0.1, depth = 0.05;
  const Mat3d turn = turned(tilt, {0, 1, 0});
  // The lower edge is at x = +1 of the box.
  const Vec3d lower = turn * Vec3d(1, 0, -1);
  const Manifold manifold = manifold_of(at(make_box(5, 5, 1), {0, 0, -1}),
                                        at(make_box(1, 1, 1), {0, 0, -lower.z() - depth}, turn));
  const double end = lower.x() - depth / std::tan(tilt);
  expect_points(manifold,
                {{lower.x(), -1, -depth}, {lower.x(), 1, -depth}, {end, -1, 0}, {end, 1, 0}},
                1e-12);
  EXPECT_NEAR(deepest(manifold), depth, 1e-14);
}

TEST(ClippedFaces, EightCornersKeepTheGreatestArea) {
  // A square turned by 45 degrees on one of the same size: a regular octagon.
  const Manifold manifold =
      manifold_of(at(make_box(1, 1, 1), {0, 0, 0}),
                  at(make_box(1, 1, 1), {0, 0, 1.99}, turned(std::numbers::pi / 4, {0, 0, 1})));
  ASSERT_EQ(manifold.count, 4);
  double doubled = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3d p = manifold.points[static_cast<std::size_t>(k)].on_b;
    const Vec3d q = manifold.points[static_cast<std::size_t>((k + 1) % 4)].on_b;
    doubled += p.x() * q.y() - p.y() * q.x();
  }
  const double radius = 1 / std::cos(std::numbers::pi / 8);
  EXPECT_NEAR(std::abs(doubled) / 2, 2 * radius * radius, 1e-13);
}

TEST(ClippedFaces, RoundBodies) {
  const Body ground = at(make_box(5, 5, 1), {0, 0, -1});
  const Body plane = at(make_halfspace({0, 0, 2}, 0), {0, 0, 0});
  const Mat3d lying = turned(std::numbers::pi / 2, {0, 1, 0});
  for (const Body& below : {ground, plane}) {
    const bool first = below.shape.kind == ShapeKind::box;
    const auto on = [&](const Body& body) {
      const bool swap = below.shape.kind < body.shape.kind;
      const Manifold m = swap ? manifold_of(below, body) : manifold_of(body, below);
      std::vector<Vec3d> points;
      for (const ContactPoint& point : m.contacts())
        points.push_back(swap ? point.on_b : point.on_a);
      return points;
    };
    const auto near = [](const Vec3d& expected, double tolerance = 1e-7) {
      return testing::Truly([=](const Vec3d& p) { return (p - expected).norm() < tolerance; });
    };
    EXPECT_THAT(on(at(make_sphere(1), {1, 2, 0.9})),
                testing::UnorderedElementsAre(near({1, 2, -0.1})))
        << first;
    EXPECT_THAT(on(at(make_ellipsoid(3, 2, 1), {1, 2, 0.9})),
                testing::UnorderedElementsAre(near({1, 2, -0.1}, 1e-4)));  // depth to 1e-10
    EXPECT_THAT(on(at(make_capsule(1, 2), {1, 2, 0.9}, lying)),
                testing::UnorderedElementsAre(near({-1, 2, -0.1}), near({3, 2, -0.1})));
    EXPECT_THAT(on(at(make_capsule(1, 2), {1, 2, 2.9})),
                testing::UnorderedElementsAre(near({1, 2, -0.1})));
    EXPECT_THAT(on(at(make_cylinder(1, 2), {1, 2, 0.9}, lying)),
                testing::UnorderedElementsAre(near({-1, 2, -0.1}), near({3, 2, -0.1})));
    EXPECT_THAT(on(at(make_cone(1, 2), {1, 2, 1.9}, turned(std::numbers::pi, {1, 0, 0}))),
                testing::UnorderedElementsAre(near({1, 2, -0.1})));
    // Standing on their discs: any square in the rim is the greatest.
    for (const Shape& standing : {make_cylinder(1, 2), make_cone(1, 2)}) {
      const std::vector<Vec3d> points = on(at(standing, {1, 2, 1.9}));
      ASSERT_EQ(points.size(), 4u);
      Vec3d sum = Vec3d::Zero();
      for (const Vec3d& p : points) {
        EXPECT_NEAR(std::hypot(p.x() - 1, p.y() - 2), 1, 1e-9);
        EXPECT_NEAR(p.z(), -0.1, 1e-9);
        sum += p / 4;
      }
      EXPECT_LT((sum - Vec3d(1, 2, -0.1)).norm(), 1e-7);
    }
  }
}

TEST(ClippedFaces, ParallelCapsulesHaveTwoPointsAndCrossedOne) {
  const Shape capsule = make_capsule(1, 2);
  const Manifold along = manifold_of(at(capsule, {0, 0, 0}), at(capsule, {1.5, 0, 1}));
  expect_points(along, {{0.5, 0, -1}, {0.5, 0, 2}}, 1e-13);
  const Manifold across =
      manifold_of(at(capsule, {0, 0, 0}), at(capsule, {1.5, 0, 0}, turned(0.3, {1, 0, 0})));
  expect_points(across, {{0.5, 0, 0}}, 1e-13);
}

TEST(ClippedFaces, FlatHulls) {
  Shape square;
  square.kind = ShapeKind::hull;
  square.hull = touchstone::make_hull({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  ASSERT_EQ(square.hull->dimension, 2);
  for (const double side : {0.0, std::numbers::pi}) {
    const Manifold manifold = manifold_of(at(make_box(5, 5, 1), {0, 0, 0}),
                                          at(square, {0, 0, 0.75}, turned(side, {1, 0, 0})));
    expect_points(manifold, {{-1, -1, 0.75}, {1, -1, 0.75}, {-1, 1, 0.75}, {1, 1, 0.75}}, 1e-13);
    EXPECT_NEAR(deepest(manifold), 0.25, 1e-14);
  }
  Shape segment;
  segment.kind = ShapeKind::hull;
  segment.hull = touchstone::make_hull({{-1, 0, 0}, {0.5, 0, 0}, {1, 0, 0}});
  expect_points(manifold_of(at(make_box(5, 5, 1), {0, 0, 0}), at(segment, {0, 0, 0.75})),
                {{-1, 0, 0.75}, {1, 0, 0.75}}, 1e-13);
}

TEST(ClippedFaces, ASolidHullWithoutFacesSaysSo) {
  const Shape box = hull_of_box(1, 1, 1);
  const Manifold manifold = manifold_of(at(make_box(5, 5, 1), {0, 0, 0}),
                                        at(make_hull(box.hull->vertices), {0, 0, 1.75}));
  EXPECT_EQ(manifold.status, Status::degenerate);
  EXPECT_EQ(manifold.count, 1);
}

TEST(ClippedFaces, ApartThereAreNoPoints) {
  Random random(7);
  int apart = 0, common = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool hulls = i % 2 == 0;
    const Shape shape = hulls ? hull_of_box(1, 0.5, 0.3) : make_box(1, 0.5, 0.3);
    const Body a = at(shape, random.vector(0.8), random.rotation());
    const Body b = at(shape, random.vector(0.8), random.rotation());
    for (const Precision scalar : {Precision::float64, Precision::float32}) {
      const Manifold manifold = manifold_of(a, b, scalar);
      ++(manifold.answer == Answer::separated ? apart : common);
      EXPECT_NE(manifold.answer, Answer::unknown);
    }
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(common, 500);
}

TEST(ClippedFaces, FeaturesStayWhileTheBodiesSlide) {
  const Body ground = at(make_box(2, 2, 1), {0, 0, 0});
  for (const Shape& shape : {make_box(1, 1, 1), hull_of_box(1, 1, 1)}) {
    const auto names = [&](double x) {
      std::vector<std::uint64_t> list;
      for (const ContactPoint& point : manifold_of(ground, at(shape, {x, 0.3, 1.9})).contacts()) {
        list.push_back(point.feature);
      }
      return list;
    };
    const auto here = names(1.5), there = names(1.6), inside = names(0.2);
    EXPECT_EQ(here, there);
    EXPECT_NE(here, inside);
    EXPECT_EQ(std::set<std::uint64_t>(here.begin(), here.end()).size(), 4u);
    EXPECT_THAT(here, testing::Not(testing::Contains(0u)));
  }
}

TEST(ClippedFaces, HalfSpacesHaveNone) {
  EXPECT_FALSE(offers(*registry::find<ManifoldEntry>("clipped-faces"), ShapeKind::halfspace,
                      ShapeKind::halfspace));
}

}  // namespace
}  // namespace touchstone::reference
