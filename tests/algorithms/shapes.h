// Shapes in one line each, for tests.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algorithms/core/shape.h"

namespace touchstone::reference {

inline Shape make_round(ShapeKind kind, double radius, double half_length) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
inline Shape make_sphere(double radius) { return make_round(ShapeKind::sphere, radius, 0); }
inline Shape make_capsule(double radius, double half_length) {
  return make_round(ShapeKind::capsule, radius, half_length);
}
inline Shape make_cylinder(double radius, double half_length) {
  return make_round(ShapeKind::cylinder, radius, half_length);
}
inline Shape make_cone(double radius, double half_length) {
  return make_round(ShapeKind::cone, radius, half_length);
}
inline Shape make_box(double x, double y, double z) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = {x, y, z};
  return shape;
}
inline Shape make_ellipsoid(double x, double y, double z) {
  Shape shape;
  shape.kind = ShapeKind::ellipsoid;
  shape.radii = {x, y, z};
  return shape;
}
// Vertices only: no faces, edges or neighbours.
inline Shape make_hull(std::vector<Vec3d> vertices) {
  auto hull = std::make_shared<Hull>();
  hull->vertices = std::move(vertices);
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return shape;
}
inline Shape make_halfspace(const Vec3d& normal, double offset) {
  Shape shape;
  shape.kind = ShapeKind::halfspace;
  shape.normal = normal;
  shape.offset = offset;
  return shape;
}

}  // namespace touchstone::reference
