// Bodies that representations are tested on, and exact answers about them.
#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/oracle/oracle.h"
#include "harness/base/random.h"
#include "harness/geometry/tessellation.h"
#include "harness/proxies/representation.h"

namespace touchstone {

struct NamedShape {
  std::string name;
  Shape shape;
  bool flat = false;
};

inline Shape hull_shape(const std::vector<Vec3d>& points) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_hull(points);
  return shape;
}

inline Shape round_shape(ShapeKind kind, double radius, double half_length, const Vec3d& radii) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  shape.half_extents = shape.radii = radii;
  return shape;
}

inline std::vector<Vec3d> random_points(base::Random& random, int count, const Vec3d& scale,
                                        const Vec3d& at) {
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) points.push_back(at + scale.cwiseProduct(random.in_ball()));
  return points;
}

inline std::vector<NamedShape> round_shapes() {
  const Vec3d radii(0.5, 2, 0.8);
  std::vector<NamedShape> shapes;
  for (double scale : {1.0, 1e-7, 3e8}) {
    const std::string at = scale == 1 ? "" : scale < 1 ? " tiny" : " huge";
    const auto add = [&](const char* name, ShapeKind kind, double r, double h, const Vec3d& e) {
      shapes.push_back({name + at, round_shape(kind, scale * r, scale * h, scale * e)});
    };
    add("sphere", ShapeKind::sphere, 0.7, 0, radii);
    add("capsule", ShapeKind::capsule, 0.4, 1.1, radii);
    add("box", ShapeKind::box, 0, 0, radii);
    add("cylinder", ShapeKind::cylinder, 0.6, 1.3, radii);
    add("disc", ShapeKind::cylinder, 1.6, 0.1, radii);
    add("cone", ShapeKind::cone, 0.9, 1.2, radii);
    add("ellipsoid", ShapeKind::ellipsoid, 0, 0, radii);
  }
  return shapes;
}

inline std::vector<NamedShape> hulls() {
  base::Random random(7);
  std::vector<NamedShape> shapes;
  const auto add = [&](const std::string& name, const std::vector<Vec3d>& points,
                       bool flat = false) {
    shapes.push_back({name, hull_shape(points), flat});
  };
  const Vec3d zero = Vec3d::Zero();
  for (int n : {4, 8, 30, 120})
    add(fmt::format("{} points", n), random_points(random, n, {1, 2, 0.7}, zero));
  add("far off", random_points(random, 20, {1, 1, 1}, {1e7, -2e7, 0.5}));
  add("needle", random_points(random, 20, {1, 1e-6, 1e-6}, zero));
  add("plate", random_points(random, 20, {1, 1, 1e-6}, {3, 2, 1}));
  const Mat3d turn = random.rotation();
  std::vector<Vec3d> turned = random_points(random, 20, {1, 1e-5, 1e-4}, zero);
  for (Vec3d& p : turned) p = turn * p;
  add("turned sliver", turned);
  add("tiny", random_points(random, 16, {1e-9, 2e-9, 1e-9}, {1e-3, 0, 0}));
  add("huge", random_points(random, 16, {1e12, 2e12, 1e12}, {-4e12, 0, 0}));
  std::vector<Vec3d> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  add("cube", cube);
  for (Vec3d& p : cube) p = turn * p;
  add("turned cube", cube);
  add("flat", random_points(random, 12, {1, 0.5, 0}, {0, 0, 2}), true);
  add("square far off", {{1e6, 0, 0}, {1e6, 1, 0}, {1e6, 0, 1}, {1e6, 1, 1}}, true);
  add("segment", {{1, 2, 3}, {2, 4, 9}}, true);
  add("point", {{5, -1, 1e5}}, true);
  return shapes;
}

// The vertices, or points of the surface, which rounding may have put outside by its last digits.
inline std::vector<Vec3d> points_of(const Shape& shape) {
  if (shape.kind == ShapeKind::hull) return shape.hull->vertices;
  std::vector<Vec3d> points = geometry::as_polytope(shape, 3).hull->vertices;
  for (Vec3d& p : points) p *= 1 - 1e-14;
  return points;
}

// Exactly.
class Exact {
 public:
  // The point is in a frame of its own.
  bool holds(const proxies::Part& part, const Vec3d& point, const Pose& frame = {}) {
    const oracle::Solid solid(part.shape), at(hull_shape({point}));
    return oracle_.verdict({solid, part.pose}, {at, frame}) != Answer::separated;
  }
  // The depth of a point (of a frame) inside the shape, rounded down; negative outside.
  double depth(const Shape& shape, const Vec3d& point, const Pose& frame) {
    const oracle::Solid solid(shape), at(hull_shape({point}));
    return -oracle_.measure({solid, Pose{}}, {at, frame}).upper;
  }

 private:
  oracle::Oracle oracle_;
};

}  // namespace touchstone
