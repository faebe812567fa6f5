// The table of margins, and the size of a pair from its shapes.
#include "harness/grade/margins.h"

#include <algorithm>
#include <limits>

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

Margins documented_margins(Precision scalar, bool extreme) {
  if (scalar == Precision::float32) {
    return {.verdict = extreme ? 1e-4 : 1e-5, .length = 1e-4, .resolution = 4e-5};
  }
  return {.verdict = extreme ? 1e-9 : 1e-12, .length = 1e-9, .resolution = 6e-14};
}

double grazing_band(double size, double reach, Precision scalar) {
  const bool single = scalar == Precision::float32;
  const double epsilon =
      single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  return (single ? 1e-4 : 1e-6) * size + 8 * epsilon * reach;
}

}  // namespace touchstone::grade
