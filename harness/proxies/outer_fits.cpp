// Outer proxies: ball, boxes, k-DOPs and hulls with proven containment.
#include "harness/proxies/fits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "harness/geometry/optimal_fits.h"
#include "harness/geometry/tessellation.h"
#include "harness/proxies/local_body.h"

namespace touchstone::proxies {
namespace {

constexpr double thinnest = 0x1p-26;     // half the thickness that a flat body's proxy gets
constexpr double same_corner = 0x1p-30;  // corners nearer than this are merged

Part certain(const LocalBody& body, const std::vector<Vec3d>& points) {
  std::optional<Shape> hull = hull_that_holds(body, points);
  if (!hull)
    throw base::InputError("no polytope around the body could be proven; expected a rounder one");
  return {*hull, {}};
}

// The half-space along n that contains the body, with a small margin around its middle.
geometry::Plane plane_around(const LocalBody& body, const Vec3d& n) {
  const double far = std::max(reach(body, n, body.middle), thinnest * body.size * n.norm());
  return {n, n.dot(body.middle) + far};
}

std::vector<Vec3d> corners_of(const LocalBody& body, const std::vector<geometry::Plane>& planes) {
  const Vec3d room = Vec3d::Constant(2 * body.size);
  return geometry::intersection(body.middle - room, body.middle + room, planes)
      .corners(same_corner * body.size);
}

double volume_of(const Part& part) { return geometry::Polyhedron::of(*part.shape.hull).volume(); }

// Vertices near the surface of the shape.
std::vector<Vec3d> vertices_near(const LocalBody& body) {
  if (body.shape.kind == ShapeKind::hull) return body.shape.hull->vertices;
  return geometry::as_polytope(body.shape, 3).hull->vertices;
}

std::vector<Vec3d> normals_near(const LocalBody& body) {
  const bool is_hull = body.shape.kind == ShapeKind::hull;
  const Shape polytope = is_hull ? body.shape : geometry::as_polytope(body.shape, 3);
  std::vector<Vec3d> normals;
  for (const Hull::Face& face : polytope.hull->faces) normals.push_back(face.normal);
  return normals;
}

// Cuts the oriented box by planes of the body while the number of corners is at most `most`.
std::vector<Vec3d> cut_box(const LocalBody& body, std::size_t most) {
  const Mat3d axes = fitting_axes(body);
  std::vector<geometry::Plane> planes;
  for (int k = 0; k < 3; ++k) {
    for (double side : {-1.0, 1.0}) planes.push_back(plane_around(body, side * axes.col(k)));
  }
  const Vec3d room = Vec3d::Constant(2 * body.size);
  geometry::Polyhedron polyhedron =
      geometry::intersection(body.middle - room, body.middle + room, planes);
  const double tolerance = same_corner * body.size;
  std::vector<Vec3d> corners = polyhedron.corners(tolerance);
  std::vector<geometry::Plane> more;
  for (const Vec3d& n : normals_near(body)) more.push_back(plane_around(body, n));
  while (!more.empty()) {
    // Distances by which a corner is beyond each plane.
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < more.size(); ++i) {
      double beyond = 0;
      for (const Vec3d& c : corners) {
        beyond = std::max(beyond, more[i].normal.dot(c) - more[i].offset);
      }
      if (beyond > tolerance) order.emplace_back(beyond, i);
    }
    std::sort(order.rbegin(), order.rend());
    if (order.size() > 16) order.resize(16);
    bool cut = false;
    for (const auto& [beyond, i] : order) {
      geometry::Polyhedron tried = polyhedron;
      tried.clip(more[i]);
      std::vector<Vec3d> left = tried.corners(tolerance);
      if (left.size() > most) continue;
      polyhedron = std::move(tried);
      corners = std::move(left);
      more.erase(more.begin() + static_cast<std::ptrdiff_t>(i));
      cut = true;
      break;
    }
    if (!cut) break;
  }
  return corners;
}

}  // namespace

Part outer_sphere(const LocalBody& body) {
  const Shape& s = body.shape;
  Part part;
  part.shape.kind = ShapeKind::sphere;
  double& radius = part.shape.radius;
  switch (s.kind) {
    case ShapeKind::sphere: radius = s.radius; break;
    case ShapeKind::capsule: radius = (s.radius + s.half_length) * (1 + epsilon); break;
    case ShapeKind::box: radius = s.half_extents.norm() * (1 + 4 * epsilon); break;
    case ShapeKind::cylinder:
      radius = std::hypot(s.radius, s.half_length) * (1 + 4 * epsilon);
      break;
    case ShapeKind::ellipsoid: radius = s.radii.maxCoeff(); break;
    case ShapeKind::cone: {
      const std::array<Vec3d, 3> outline = {Vec3d(s.radius, 0, -s.half_length),
                                            Vec3d(-s.radius, 0, -s.half_length),
                                            Vec3d(0, 0, s.half_length)};
      const double z = geometry::least_ball(outline).centre.z();
      part.pose.translation = body.snap({0, 0, z});
      for (const Vec3d& p : outline) {
        const double far = (p - part.pose.translation).norm();
        radius = std::max(radius, far * (1 + 8 * epsilon));
      }
      break;
    }
    default:
      part.pose.translation = body.snap(geometry::least_ball(body.points).centre);
      for (const Vec3d& p : body.points) {
        radius = std::max(radius, (p - part.pose.translation).norm() * (1 + 8 * epsilon));
      }
  }
  return part;
}

Part outer_box(const LocalBody& body) {
  Part part;
  part.shape.kind = ShapeKind::box;
  part.shape.half_extents = body.half;
  part.pose.translation = body.middle;
  return part;
}

std::vector<Vec3d> dop_normals(int directions) {
  std::vector<Vec3d> normals = {Vec3d::UnitX(), Vec3d::UnitY(), Vec3d::UnitZ()};
  if (directions != 18) {
    for (double y : {-1.0, 1.0}) {
      for (double z : {-1.0, 1.0}) normals.emplace_back(1, y, z);
    }
  }
  if (directions != 14) {
    for (double s : {-1.0, 1.0}) {
      normals.emplace_back(1, s, 0);
      normals.emplace_back(0, 1, s);
      normals.emplace_back(s, 0, 1);
    }
  }
  return normals;
}

Part outer_dop(const LocalBody& body, int directions) {
  if (body.size == 0) return {body.shape, {}};  // a point
  std::vector<geometry::Plane> planes;
  for (const Vec3d& n : dop_normals(directions)) {
    planes.push_back(plane_around(body, n));
    planes.push_back(plane_around(body, -n));
  }
  return certain(body, corners_of(body, planes));
}

std::vector<Vec3d> farthest_vertices(const std::vector<Vec3d>& vertices, int count) {
  const auto most = static_cast<std::size_t>(count);
  if (vertices.size() <= most) return vertices;
  std::vector<Vec3d> chosen = {vertices.front()};
  // Adds the vertex farthest beyond the chosen ones. Until they form a solid, lines and planes
  // replace its faces.
  const auto add_farthest = [&](const auto& distance) {
    const Vec3d* best = nullptr;
    double greatest = 0;
    for (const Vec3d& v : vertices) {
      const double d = distance(v);
      if (!(d > greatest)) continue;
      greatest = d;
      best = &v;
    }
    if (best != nullptr) chosen.push_back(*best);
    return best != nullptr;
  };
  add_farthest([&](const Vec3d& v) { return (v - chosen[0]).norm(); });
  chosen.erase(chosen.begin());
  add_farthest([&](const Vec3d& v) { return (v - chosen[0]).norm(); });
  if (chosen.size() < 2) return chosen;
  add_farthest([&](const Vec3d& v) { return (v - chosen[0]).cross(chosen[1] - chosen[0]).norm(); });
  if (chosen.size() < 3) return chosen;
  const Vec3d normal = (chosen[1] - chosen[0]).cross(chosen[2] - chosen[0]);
  add_farthest([&](const Vec3d& v) { return std::abs(normal.dot(v - chosen[0])); });
  while (chosen.size() >= 4 && chosen.size() < most) {
    std::vector<geometry::Plane> planes;
    for (const geometry::Triangle& t : geometry::triangles_of(*make_hull(chosen))) {
      const Vec3d n = t.normal().normalized();
      planes.push_back({n, n.dot(t.a)});
    }
    const bool added = add_farthest([&](const Vec3d& v) {
      double beyond = 0;
      for (const geometry::Plane& p : planes) beyond = std::max(beyond, p.normal.dot(v) - p.offset);
      return beyond;
    });
    if (!added) break;
  }
  return chosen;
}

Part outer_reduced_hull(const LocalBody& body, int vertices) {
  if (body.shape.kind == ShapeKind::hull &&
      body.shape.hull->vertices.size() <= static_cast<std::size_t>(vertices)) {
    return outer_hull(body);
  }
  if (body.size == 0) return {body.shape, {}};
  Part best = certain(body, cut_box(body, static_cast<std::size_t>(vertices)));
  if (!body.solid) return best;
  const std::optional<Shape> scaled_up =
      hull_that_holds(body, farthest_vertices(vertices_near(body), vertices));
  if (scaled_up && volume_of({*scaled_up, {}}) < volume_of(best)) best.shape = *scaled_up;
  return best;
}

Part outer_hull(const LocalBody& body) {
  if (!body.has_mesh) return {body.shape, {}};
  if (body.solid) return certain(body, body.points);
  // A flat mesh is inside the hull of all its points.
  Part part{body.shape, {}};
  part.shape.hull = make_hull(body.points);
  return part;
}

Part outer_icosphere(const LocalBody& body, int level) {
  // Distance of the faces of the unit sphere's polytope from its centre, and of the sides of a
  // circle's.
  Shape unit;
  unit.radius = 1;
  double nearest = 1;
  for (const geometry::Triangle& t :
       geometry::triangles_of(*geometry::as_polytope(unit, level).hull)) {
    nearest = std::min(nearest, t.a.dot(t.normal().normalized()));
  }
  Shape wider = body.shape;
  const bool circle = wider.kind == ShapeKind::cylinder || wider.kind == ShapeKind::cone;
  wider.radius /= circle ? std::cos(std::numbers::pi / (8 << level)) : nearest;
  wider.radii /= nearest;
  return certain(body, geometry::as_polytope(wider, level).hull->vertices);
}

}  // namespace touchstone::proxies
