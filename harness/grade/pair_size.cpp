// Computes the size of a pair from its shapes.
#include "harness/grade/pair_size.h"

#include <algorithm>

namespace touchstone::grade {

double shape_size(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere: return 2 * shape.radius;
    case ShapeKind::capsule: return 2 * (shape.half_length + shape.radius);
    case ShapeKind::box: return 2 * shape.half_extents.maxCoeff();
    case ShapeKind::cylinder:
    case ShapeKind::cone: return 2 * std::max(shape.radius, shape.half_length);
    case ShapeKind::ellipsoid: return 2 * shape.radii.maxCoeff();
    case ShapeKind::hull: {
      Vec3d low = shape.hull->vertices.front(), high = low;
      for (const Vec3d& v : shape.hull->vertices) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
      return (high - low).maxCoeff();
    }
    case ShapeKind::halfspace: break;
  }
  return 0;
}

double pair_size(const files::Case& c) {
  return std::max(shape_size(c.shape_a), shape_size(c.shape_b));
}

}  // namespace touchstone::grade
