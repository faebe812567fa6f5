// Pairs of boxes and balls with simple exact answers.
#pragma once

#include "harness/files/cases.h"

namespace touchstone {

inline Shape ball(double radius) {
  Shape shape;
  shape.kind = ShapeKind::sphere;
  shape.radius = radius;
  return shape;
}

inline Shape cube(double half) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = Vec3d::Constant(half);
  return shape;
}

// Makes two bodies of these shapes, the second moved along x.
inline files::Case along_x(const Shape& a, const Shape& b, double x) {
  files::Case c;
  c.id = "along-x";
  c.shape_a = a;
  c.shape_b = b;
  c.pose_b.translation = {x, 0, 0};
  return c;
}

}  // namespace touchstone
