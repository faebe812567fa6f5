// Surface points of each shape, in arithmetic that rounds equally everywhere, and scaled shapes.
#include "harness/geometry/tessellation.h"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::geometry {
namespace {

// The functions below use only +, *, / and square roots, which round equally everywhere; sines do
// not.

Vec3d on_unit_sphere(const Vec3d& v) { return v / base::length(v); }

// Vertices on the unit sphere of an icosahedron whose triangles are split in four `level` times.
std::vector<Vec3d> icosphere(int level) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3d> vertices;
  for (double a : {-1.0, 1.0}) {
    for (double b : {-golden, golden}) {
      for (const Vec3d& v : {Vec3d(0, a, b), Vec3d(a, b, 0), Vec3d(b, 0, a)}) {
        vertices.push_back(on_unit_sphere(v));
      }
    }
  }
  using Triangle = std::array<std::uint32_t, 3>;
  std::vector<Triangle> triangles;  // three vertices with an edge between each two
  const auto adjacent = [&](std::uint32_t i, std::uint32_t j) {
    return vertices[i].dot(vertices[j]) > 0;
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (adjacent(i, j) && adjacent(j, k) && adjacent(i, k)) triangles.push_back({i, j, k});
      }
    }
  }
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, is_new] =
          middles.insert({std::minmax(i, j), static_cast<std::uint32_t>(vertices.size())});
      if (is_new) vertices.push_back(on_unit_sphere(vertices[i] + vertices[j]));
      return at->second;
    };
    std::vector<Triangle> split;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      split.insert(split.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(split);
  }
  return vertices;
}

// 8 * 2^level points on the unit circle in the x-y plane, anticlockwise from +x. A quarter's angle
// is halved level + 1 times: the sum of two unit vectors bisects their angle.
std::vector<Vec3d> circle(int level) {
  std::vector<Vec3d> quarter = {Vec3d::UnitX(), Vec3d::UnitY()};
  for (int l = 0; l <= level; ++l) {
    std::vector<Vec3d> finer = {quarter.front()};
    for (std::size_t i = 1; i < quarter.size(); ++i) {
      finer.push_back(on_unit_sphere(quarter[i - 1] + quarter[i]));
      finer.push_back(quarter[i]);
    }
    quarter = std::move(finer);
  }
  quarter.pop_back();
  std::vector<Vec3d> points;
  for (int turn = 0; turn < 4; ++turn) {
    for (Vec3d& p : quarter) {
      points.push_back(p);
      p = {-p.y(), p.x(), 0};
    }
  }
  return points;
}

std::vector<Vec3d> box(const Vec3d& half) {
  std::vector<Vec3d> points;
  for (double x : {-1.0, 1.0}) {
    for (double y : {-1.0, 1.0}) {
      for (double z : {-1.0, 1.0}) points.push_back(half.cwiseProduct(Vec3d(x, y, z)));
    }
  }
  return points;
}

std::vector<Vec3d> ellipsoid(const Vec3d& radii, int level) {
  std::vector<Vec3d> points = icosphere(level);
  for (Vec3d& p : points) p = radii.cwiseProduct(p);
  return points;
}

std::vector<Vec3d> capsule(double radius, double half_length, int level) {
  std::vector<Vec3d> points;
  for (const Vec3d& p : ellipsoid(Vec3d::Constant(radius), level)) {
    if (p.z() >= 0) points.push_back(p + Vec3d(0, 0, half_length));
    if (p.z() < 0 || (p.z() == 0 && half_length > 0)) {
      points.push_back(p - Vec3d(0, 0, half_length));
    }
  }
  return points;
}

std::vector<Vec3d> cylinder(double radius, double half_length, int level) {
  std::vector<Vec3d> points;
  for (double z : {-half_length, half_length}) {
    for (const Vec3d& p : circle(level)) points.emplace_back(radius * p.x(), radius * p.y(), z);
  }
  return points;
}

std::vector<Vec3d> cone(double radius, double half_length, int level) {
  std::vector<Vec3d> points = {Vec3d(0, 0, half_length)};
  for (const Vec3d& p : circle(level)) {
    points.emplace_back(radius * p.x(), radius * p.y(), -half_length);
  }
  return points;
}

std::vector<Vec3d> surface_points(const Shape& shape, int level) {
  switch (shape.kind) {
    case ShapeKind::sphere: return ellipsoid(Vec3d::Constant(shape.radius), level);
    case ShapeKind::ellipsoid: return ellipsoid(shape.radii, level);
    case ShapeKind::capsule: return capsule(shape.radius, shape.half_length, level);
    case ShapeKind::cylinder: return cylinder(shape.radius, shape.half_length, level);
    case ShapeKind::cone: return cone(shape.radius, shape.half_length, level);
    case ShapeKind::box: return box(shape.half_extents);
    case ShapeKind::hull: return shape.hull->vertices;
    case ShapeKind::halfspace: break;
  }
  throw base::InputError("a half-space has no polytope; expected a bounded shape");
}

}  // namespace

Shape as_polytope(const Shape& shape, int level) {
  if (level < 0 || level > 5) {
    throw base::InputError("polytope level " + std::to_string(level) + "; expected 0 to 5");
  }
  if (shape.kind == ShapeKind::hull) return shape;
  Shape polytope;
  polytope.kind = ShapeKind::hull;
  polytope.hull = make_hull(surface_points(shape, level));
  return polytope;
}

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

ConcaveBody scaled_body(ConcaveBody body, double factor) {
  const auto scaled_mesh = [&](TriangleMesh mesh) {
    for (Vec3d& vertex : mesh.vertices) vertex *= factor;
    return std::make_shared<const TriangleMesh>(std::move(mesh));
  };
  if (body.mesh) body.mesh = scaled_mesh(*body.mesh);
  for (CompoundSurface& surface : body.surfaces) surface.mesh = scaled_mesh(*surface.mesh);
  for (ConvexPart& part : body.parts) {
    part.shape = scaled_shape(part.shape, factor);
    part.pose.translation *= factor;
    part.rounding *= factor;
    if (part.poses == nullptr) continue;
    std::vector<Pose> poses = *part.poses;
    for (Pose& pose : poses) pose.translation *= factor;
    part.poses = std::make_shared<const std::vector<Pose>>(std::move(poses));
  }
  return body;
}

}  // namespace touchstone::geometry
