// Scales shapes.
#include "harness/geometry/shapes/scaled_shape.h"

#include <utility>
#include <vector>

#include "algorithms/hull/convex_hull.h"

namespace touchstone::geometry {

Shape scaled_shape(Shape shape, double factor) {
  if (shape.kind == ShapeKind::hull) {
    std::vector<Vec3d> vertices = shape.hull->vertices;
    for (Vec3d& v : vertices) v *= factor;
    return hull_of(std::move(vertices));
  }
  shape.radius *= factor;
  shape.half_length *= factor;
  shape.half_extents *= factor;
  shape.radii *= factor;
  shape.offset *= factor;
  return shape;
}

}  // namespace touchstone::geometry
