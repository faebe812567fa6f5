// Outer representations hold the body and inner ones are inside it: exactly, by the oracle.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "tests/harness/proxies/bodies.h"

namespace touchstone {
namespace {

const std::vector<proxies::Representation>& forms(proxies::Side side) {
  static std::vector<proxies::Representation> lists[3];
  std::vector<proxies::Representation>& list = lists[static_cast<std::size_t>(side)];
  if (list.empty()) {
    for (proxies::Form form :
         {proxies::Form::sphere, proxies::Form::box, proxies::Form::oriented_box,
          proxies::Form::dop14, proxies::Form::dop18, proxies::Form::dop26, proxies::Form::capsule,
          proxies::Form::hull, proxies::Form::parts}) {
      list.push_back({form, side, 0});
    }
    for (int k : {8, 16, 40}) list.push_back({proxies::Form::reduced_hull, side, k});
    for (int level : {0, 2}) list.push_back({proxies::Form::icosphere, side, level});
  }
  return list;
}

std::vector<NamedShape> all_bodies() {
  std::vector<NamedShape> all = round_shapes();
  for (NamedShape& shape : hulls()) all.push_back(std::move(shape));
  return all;
}

bool same(const Shape& a, const proxies::Part& part) {
  return part.shape.kind == a.kind && part.shape.hull == a.hull && part.shape.radius == a.radius &&
         part.pose.translation == Vec3d::Zero();
}

TEST(Outer, HoldsEveryPointOfTheBody) {
  Exact exact;
  for (const NamedShape& body : all_bodies()) {
    for (const proxies::Representation& r : forms(proxies::Side::outer)) {
      SCOPED_TRACE(body.name + ", " + to_string(r));
      std::vector<proxies::Part> parts;
      EXPECT_NO_THROW(parts = proxies::represent(body.shape, nullptr, r));
      if (parts.empty()) continue;
      const std::vector<Vec3d> points = points_of(body.shape);
      const std::size_t step = points.size() / 60 + 1;
      for (std::size_t i = 0; i < points.size(); i += step) {
        ASSERT_TRUE(exact.holds(parts[0], points[i])) << body.name << ", " << to_string(r);
      }
    }
  }
}

TEST(Inner, IsInsideTheBody) {
  Exact exact;
  for (const NamedShape& body : all_bodies()) {
    for (const proxies::Representation& r : forms(proxies::Side::inner)) {
      if (body.flat && r.form != proxies::Form::hull && r.form != proxies::Form::parts &&
          r.form != proxies::Form::icosphere) {
        EXPECT_THROW(proxies::represent(body.shape, nullptr, r), base::InputError)
            << body.name << to_string(r);
        continue;
      }
      const proxies::Part part = proxies::represent(body.shape, nullptr, r).at(0);
      if (same(body.shape, part)) continue;
      const Shape& s = part.shape;
      if (s.kind == ShapeKind::sphere || s.kind == ShapeKind::capsule) {
        ASSERT_GT(s.radius, 0);
        const double half = s.kind == ShapeKind::capsule ? s.half_length : 0;
        for (double end : {-half, half}) {
          const double depth = exact.depth(body.shape, {0, 0, end}, part.pose);
          // The oracle has only an enclosure for round cores.
          ASSERT_GE(depth, s.radius * (1 - 1e-3)) << body.name << ", " << to_string(r);
          if (body.shape.kind == ShapeKind::hull) {
            ASSERT_GE(depth, s.radius) << body.name << ", " << to_string(r);
          }
        }
        continue;
      }
      const Shape polytope = s.kind == ShapeKind::box ? geometry::as_polytope(s, 0) : s;
      for (const Vec3d& p : polytope.hull->vertices) {
        ASSERT_TRUE(exact.holds({body.shape, {}}, p, part.pose))
            << body.name << ", " << to_string(r);
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
