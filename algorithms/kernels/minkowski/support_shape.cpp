// Prepares shapes for support maps: centre, unit and vertices.
#include "algorithms/kernels/minkowski/support_shape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// The cube map is faster than a scan for more vertices than this.
constexpr std::size_t most_vertices_to_scan = 192;

// The depth of the body's origin inside the faces (metres); zero if there are no faces.
double origin_depth(const Hull& hull) {
  double depth = hull.faces.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (const Hull::Face& face : hull.faces) {
    depth = std::min(depth, face.normal.dot(hull.vertices[face.loop[0]]));
  }
  return depth;
}

template <class Scalar>
void prepare_hull(SupportShape<Scalar>& shape, const Hull& hull) {
  const std::vector<Vec3d>& vertices = hull.vertices;
  // The mean is computed relative to the first vertex, so that it is exact enough wherever the hull
  // is.
  Vec3d mean = Vec3d::Zero();
  for (const Vec3d& vertex : vertices) mean += vertex - vertices[0];
  shape.centre = vertices[0] + mean / static_cast<double>(vertices.size());
  // A body's origin well inside the hull is as good a centre, and the pose gives its position
  // exactly.
  if (origin_depth(hull) > 0.125 * (vertices[0] - shape.centre).stableNorm()) {
    shape.centre = Vec3d::Zero();
  }
  for (const Vec3d& vertex : vertices) {
    shape.size = std::max(shape.size, (vertex - shape.centre).stableNorm());
  }
  shape.unit = power_of_two_above(shape.size);
  shape.is_centred = shape.centre.isZero(0);
  shape.is_near_origin = shape.centre.cwiseAbs().maxCoeff() <= shape.size;

  std::vector<Vec3<Scalar>> scaled;
  scaled.reserve(vertices.size());
  shape.corners.reserve(vertices.size());
  for (const Vec3d& vertex : vertices) {
    scaled.push_back(((vertex - shape.centre) / shape.unit).template cast<Scalar>());
    shape.corners.push_back({scaled.back().x(), scaled.back().y(), scaled.back().z()});
  }
  if (scaled.size() > most_vertices_to_scan &&
      scaled.size() <= SupportCubeMap<Scalar>::most_vertices) {
    shape.cells = SupportCubeMap<Scalar>(scaled);
  } else {
    shape.vertices =
        hull_scan::blocks_of<Scalar>(scaled.size(), [&](std::size_t k) { return scaled[k]; });
    // Coordinates are above 1 where the unit is the greatest that there is.
    if (sizeof(Scalar) == sizeof(double) && shape.size < shape.unit &&
        hull_scan::is_scanned_in_floats(shape.vertices.size())) {
      shape.rough = hull_scan::blocks_of<float>(scaled.size(), [&](std::size_t k) {
        return Vec3<float>(scaled[k].template cast<float>());
      });
    }
  }
}

}  // namespace

template <class Scalar>
SupportShape<Scalar>::SupportShape(const Shape& shape) {
  const auto set = [&](Core kind, const Vec3d& metres, double greatest_distance) {
    core = kind;
    size = greatest_distance;
    unit = power_of_two_above(size);
    extents = (metres / unit).template cast<Scalar>();
  };
  const Vec3d round{shape.radius, shape.radius, shape.half_length};
  switch (shape.kind) {
    case ShapeKind::sphere: radius = shape.radius; break;
    case ShapeKind::capsule:
      set(Core::segment, {0, 0, shape.half_length}, shape.half_length);
      radius = shape.radius;
      break;
    case ShapeKind::box: set(Core::box, shape.half_extents, shape.half_extents.stableNorm()); break;
    case ShapeKind::cylinder:
      set(Core::cylinder, round, std::hypot(shape.radius, shape.half_length));
      break;
    case ShapeKind::cone:
      set(Core::cone, round, std::hypot(shape.radius, shape.half_length));
      break;
    case ShapeKind::ellipsoid: set(Core::ellipsoid, shape.radii, shape.radii.maxCoeff()); break;
    case ShapeKind::hull:
      core = Core::hull;
      prepare_hull(*this, *shape.hull);
      break;
    case ShapeKind::halfspace:
      core = Core::halfspace;
      normal = shape.normal;
      offset = shape.offset;
      break;
  }
}

template <class Scalar>
std::vector<SupportShape<Scalar>> make_support_shapes(std::span<const Shape> shapes) {
  std::vector<SupportShape<Scalar>> result;
  result.reserve(shapes.size());
  for (const Shape& shape : shapes) result.emplace_back(shape);
  return result;
}

template struct SupportShape<float>;
template struct SupportShape<double>;
template std::vector<SupportShape<float>> make_support_shapes(std::span<const Shape>);
template std::vector<SupportShape<double>> make_support_shapes(std::span<const Shape>);

}  // namespace touchstone
