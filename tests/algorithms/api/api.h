// The interface's types from those of the core, for its tests. There the interface's names are in touchstone::v1.
#pragma once

#include <limits>
#include <touchstone/touchstone.hpp>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::api_test {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline v1::Vec3 outer(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

inline v1::Pose outer(const Pose& pose) {
  return {outer(pose.rotation.col(0)), outer(pose.rotation.col(1)), outer(pose.rotation.col(2)),
          outer(pose.translation)};
}

inline v1::Shape outer(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere: return v1::Shape::sphere(shape.radius);
    case ShapeKind::capsule: return v1::Shape::capsule(shape.radius, shape.half_length);
    case ShapeKind::box: return v1::Shape::box(outer(shape.half_extents));
    case ShapeKind::cylinder: return v1::Shape::cylinder(shape.radius, shape.half_length);
    case ShapeKind::cone: return v1::Shape::cone(shape.radius, shape.half_length);
    case ShapeKind::ellipsoid: return v1::Shape::ellipsoid(outer(shape.radii));
    case ShapeKind::halfspace: return v1::Shape::halfspace(outer(shape.normal), shape.offset);
    case ShapeKind::hull: break;
  }
  std::vector<v1::Vec3> points;
  for (const Vec3d& vertex : shape.hull->vertices) points.push_back(outer(vertex));
  return v1::Shape::hull(points);
}

}  // namespace touchstone::api_test
