#include "harness/geometry/tessellation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "harness/base/error.h"

namespace touchstone {
namespace {

Shape make(ShapeKind kind) {
  Shape shape;
  shape.kind = kind;
  shape.radius = 0.7;
  shape.half_length = 1.3;
  shape.half_extents = {1, 2, 3};
  shape.radii = {0.5, 1, 2};
  return shape;
}

// The distance of a point from the shape (metres, roughly); 0 on the surface, < 0 inside.
double outside(const Shape& s, const Vec3d& p) {
  const double z = std::abs(p.z());
  const double r = p.head<2>().norm();
  switch (s.kind) {
    case ShapeKind::sphere: return p.norm() - s.radius;
    case ShapeKind::ellipsoid: return p.cwiseQuotient(s.radii).norm() - 1;
    case ShapeKind::capsule: return std::hypot(r, std::max(0.0, z - s.half_length)) - s.radius;
    case ShapeKind::cylinder: return std::max(r - s.radius, z - s.half_length);
    case ShapeKind::cone:
      return std::max(-s.half_length - p.z(),
                      r - s.radius * (s.half_length - p.z()) / (2 * s.half_length));
    case ShapeKind::box: return (p.cwiseAbs() - s.half_extents).maxCoeff();
    default: return 1;
  }
}

struct Counts {
  std::size_t vertices, faces;
};

TEST(Polytope, CountsOfEachKindAndLevel) {
  const std::map<ShapeKind, std::array<Counts, 3>> expected = {
      {ShapeKind::sphere, {{{12, 20}, {42, 80}, {162, 320}}}},
      {ShapeKind::ellipsoid, {{{12, 20}, {42, 80}, {162, 320}}}},
      {ShapeKind::box, {{{8, 6}, {8, 6}, {8, 6}}}},
      {ShapeKind::cylinder, {{{16, 10}, {32, 18}, {64, 34}}}},
      {ShapeKind::cone, {{{9, 9}, {17, 17}, {33, 33}}}},
  };
  for (const auto& [kind, counts] : expected) {
    for (int level = 0; level < 3; ++level) {
      const auto polytope = geometry::as_polytope(make(kind), level).hull;
      const Hull& hull = *polytope;
      SCOPED_TRACE(testing::Message() << to_string(kind) << " level " << level);
      const auto at = static_cast<std::size_t>(level);
      EXPECT_EQ(hull.vertices.size(), counts[at].vertices);
      EXPECT_EQ(hull.faces.size(), counts[at].faces);
      EXPECT_EQ(hull.vertices.size() + hull.faces.size(), hull.edges.size() + 2);
    }
  }
  EXPECT_EQ(geometry::as_polytope(make(ShapeKind::sphere), 3).hull->faces.size(), 1280u);
  const auto finest = geometry::as_polytope(make(ShapeKind::sphere), 5).hull;
  EXPECT_EQ(finest->vertices.size(), 10242u);
  EXPECT_EQ(finest->faces.size(), 20480u);
}

TEST(Polytope, EveryVertexIsACornerOnTheSurface) {
  for (ShapeKind kind : {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box, ShapeKind::cylinder,
                         ShapeKind::cone, ShapeKind::ellipsoid}) {
    for (int level = 0; level <= 3; ++level) {
      const Shape shape = make(kind);
      const Shape polytope = geometry::as_polytope(shape, level);
      ASSERT_EQ(polytope.kind, ShapeKind::hull);
      const Hull& hull = *polytope.hull;
      ASSERT_FALSE(hull.faces.empty());
      for (std::size_t v = 0; v < hull.vertices.size(); ++v) {
        EXPECT_NEAR(outside(shape, hull.vertices[v]), 0, 1e-15);
        EXPECT_GE(hull.neighbours[v].size(), 3u) << to_string(kind) << level << ' ' << v;
      }
    }
  }
}

TEST(Polytope, CapsuleIsASphereDrawnApart) {
  const Shape capsule = make(ShapeKind::capsule);
  for (int level = 0; level <= 3; ++level) {
    double top = 0;
    int rim = 0;
    const Shape polytope = geometry::as_polytope(capsule, level);
    for (const Vec3d& p : polytope.hull->vertices) {
      EXPECT_GE(std::abs(p.z()), capsule.half_length);
      top = std::max(top, p.z());
      rim += p.z() == capsule.half_length;
    }
    EXPECT_GE(rim, 4);
    EXPECT_LE(top, capsule.half_length + capsule.radius + 1e-15);
    EXPECT_GE(top, capsule.half_length + 0.85 * capsule.radius);
  }
  Shape round = capsule;
  round.half_length = 0;
  EXPECT_EQ(geometry::as_polytope(round, 1).hull->vertices.size(), 42u);
}

// Literal bits: the same on every platform, or this fails there.
TEST(Polytope, BitsArePortable) {
  const auto digest = [](const Hull& hull) {
    std::uint64_t sum = 0;
    for (const Vec3d& p : hull.vertices) {
      for (double c : p) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &c, sizeof bits);
        sum = sum * 1099511628211u + bits;
      }
    }
    return sum;
  };
  EXPECT_EQ(digest(*geometry::as_polytope(make(ShapeKind::sphere), 2).hull), 7836294144567020780u);
  EXPECT_EQ(digest(*geometry::as_polytope(make(ShapeKind::cylinder), 3).hull),
            16200604233875031776u);
}

TEST(Polytope, FlatAndEmptySizes) {
  Shape shape = make(ShapeKind::sphere);
  shape.radius = 0;
  EXPECT_EQ(geometry::as_polytope(shape, 1).hull->dimension, 0);
  shape = make(ShapeKind::cylinder);
  shape.half_length = 0;
  EXPECT_EQ(geometry::as_polytope(shape, 1).hull->dimension, 2);
  shape = make(ShapeKind::cone);
  shape.radius = 0;
  EXPECT_EQ(geometry::as_polytope(shape, 1).hull->dimension, 1);
  shape = make(ShapeKind::ellipsoid);
  shape.radii.z() = 0;
  EXPECT_EQ(geometry::as_polytope(shape, 1).hull->dimension, 2);
  shape.radii.z() = 1e-8;
  const auto lens = geometry::as_polytope(shape, 2).hull;
  EXPECT_EQ(lens->dimension, 3);
  EXPECT_EQ(lens->faces.size(), 320u);
}

TEST(Polytope, RefusesHalfSpacesAndLevels) {
  EXPECT_THROW(geometry::as_polytope(make(ShapeKind::halfspace), 1), base::InputError);
  EXPECT_THROW(geometry::as_polytope(make(ShapeKind::sphere), -1), base::InputError);
  EXPECT_THROW(geometry::as_polytope(make(ShapeKind::box), 6), base::InputError);
  Shape hull = geometry::as_polytope(make(ShapeKind::box), 0);
  EXPECT_EQ(geometry::as_polytope(hull, 3).hull, hull.hull);
}

}  // namespace
}  // namespace touchstone
