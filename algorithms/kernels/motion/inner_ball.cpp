// Balls inside of shapes, and the hull of a ball and a point.
#include "algorithms/kernels/motion/inner_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/motion/length.h"

namespace touchstone {

double inner_radius(const Shape& shape, const SupportShape<double>& support) {
  constexpr double inward = 1 - 1e-12;
  switch (shape.kind) {
    case ShapeKind::box: return shape.half_extents.minCoeff();
    case ShapeKind::ellipsoid: return shape.radii.minCoeff() * inward;
    case ShapeKind::cylinder: return std::min(shape.radius, shape.half_length);
    case ShapeKind::cone: {
      // The side from the tip to the rim is nearer to the middle of the axis than the base.
      const double slant = std::hypot(shape.radius, 2 * shape.half_length);
      return slant > 0 ? shape.radius * shape.half_length / slant * inward : 0;
    }
    case ShapeKind::hull: {
      const Hull& hull = *shape.hull;
      double depth = hull.faces.empty() ? 0 : std::numeric_limits<double>::infinity();
      for (const Hull::Face& face : hull.faces) {
        const Vec3d& corner = hull.vertices[face.loop[0]];
        depth = std::min(depth, face.normal.dot(corner - support.centre));
      }
      // Normals are accurate to rounding of the size and of the distance from the origin.
      return depth - 1e-9 * (support.size + support.centre.norm());
    }
    default: return 0;
  }
}

std::vector<double> inner_radii(std::span<const Shape> shapes,
                                std::span<const SupportShape<double>> support_shapes) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    radii.push_back(inner_radius(shapes[i], support_shapes[i]));
  }
  return radii;
}

bool is_in_front_of_ball(const Vec3d& point, const Vec3d& centre, double radius, double rounding) {
  if (length_of(centre) + rounding < radius) return true;
  const double length = length_of(point);
  if (!(length > 4 * rounding)) return false;
  const Vec3d along = -point / length;
  const double ahead = along.dot(centre);
  const double aside = length_of(centre - ahead * along);
  return ahead > 0 && aside + 2 * rounding * (ahead + length) / length + rounding < radius;
}

}  // namespace touchstone
