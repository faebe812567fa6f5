// Inner proxies of a convex body: each shrinks until its clearance is certain.
#include "harness/proxies/fits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "harness/geometry/optimal_fits.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::proxies {
namespace {

Inside inside_of(const LocalBody& body) {
  Inside inside(body);
  if (!inside.has_interior()) {
    throw base::InputError(
        "nothing is certainly inside a body that is flat, or thin to rounding; expected "
        "an outer representation, or a solid body");
  }
  return inside;
}

// The greatest copy of the hull of `corners` (around zero) that is certainly inside. Corner i of
// the copy is centre + scale * corners[i], up to 4 units in the last place of the body's size.
geometry::Copy copy_inside(const LocalBody& body, const Inside& inside,
                           const std::vector<Vec3d>& corners) {
  const auto support = [&](const Vec3d& n) {
    double far = 0;
    for (const Vec3d& c : corners) far = std::max(far, n.dot(c));
    return far;
  };
  geometry::Copy copy =
      geometry::greatest_copy(inside.planes(), support, inside.deepest(), 4 * body.size);
  const bool round = body.shape.kind != ShapeKind::hull;
  if (round) copy.centre = {0, 0, body.shape.kind == ShapeKind::cone ? copy.centre.z() : 0};
  copy.centre = body.snap(copy.centre);
  const auto fits = [&](double scale) {
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3d& c) {
      return inside.clearance(copy.centre + scale * c) >= 8 * epsilon * body.size;
    });
  };
  // A round shape is slightly larger than its polytope.
  double low = 0, high = copy.scale * (round ? 1.05 : 1 + 0x1p-30);
  if (copy.scale > 0 && fits(copy.scale * (1 - 0x1p-30))) low = copy.scale * (1 - 0x1p-30);
  for (int step = 0; step < 60 && copy.scale > 0; ++step) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  copy.scale = low;
  if (!(low > 0)) {
    throw base::InputError(
        "nothing of this form is certainly inside the body; expected a thicker one");
  }
  return copy;
}

std::vector<Vec3d> box_corners(const Part& box) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    corners.push_back(box.pose.rotation * sign.cwiseProduct(box.shape.half_extents));
  }
  return corners;
}

Part copy_of_box(const LocalBody& body, Part box) {
  const Inside inside = inside_of(body);
  if (body.shape.kind == ShapeKind::box) return box;
  const geometry::Copy copy = copy_inside(body, inside, box_corners(box));
  box.shape.half_extents *= copy.scale;
  box.pose.translation = copy.centre;
  return box;
}

Part hull_part(const std::vector<Vec3d>& points) {
  Part part;
  part.shape.kind = ShapeKind::hull;
  part.shape.hull = make_hull(points);
  return part;
}

}  // namespace

Part inner_sphere(const LocalBody& body) {
  const Inside inside = inside_of(body);
  Part part;
  part.shape.kind = ShapeKind::sphere;
  part.pose.translation = inside.deepest();
  part.shape.radius =
      body.shape.kind == ShapeKind::sphere ? body.shape.radius : inside.clearance(inside.deepest());
  return part;
}

Part inner_box(const LocalBody& body) { return copy_of_box(body, outer_box(body)); }

Part inner_oriented_box(const LocalBody& body) {
  return copy_of_box(body, outer_oriented_box(body));
}

Part inner_dop(const LocalBody& body, int directions) {
  const Inside inside = inside_of(body);
  const Part outer = outer_dop(body, directions);
  std::vector<Vec3d> corners;
  for (const Vec3d& v : outer.shape.hull->vertices) corners.push_back(v - body.middle);
  const geometry::Copy copy = copy_inside(body, inside, corners);
  for (Vec3d& c : corners) c = copy.centre + copy.scale * c;
  return hull_part(corners);
}

Part inner_capsule(const LocalBody& body) {
  const Shape& s = body.shape;
  const Inside inside = inside_of(body);
  Part best;
  best.shape.kind = ShapeKind::capsule;
  best.shape.radius = s.radius;
  if (s.kind == ShapeKind::sphere) return best;
  best.shape.half_length = s.half_length;
  if (s.kind == ShapeKind::capsule) return best;
  const Mat3d axes = fitting_axes(body);
  double greatest = -1;
  const auto consider = [&](int k, double ratio) {
    const Vec3d axis = axes.col(k);
    const auto support = [&](const Vec3d& n) { return n.norm() + ratio * std::abs(n.dot(axis)); };
    geometry::Copy copy =
        geometry::greatest_copy(inside.planes(), support, inside.deepest(), 4 * body.size);
    if (!(copy.scale > 0)) return -1.0;
    if (s.kind != ShapeKind::hull) {
      copy.centre = {0, 0, s.kind == ShapeKind::cone ? copy.centre.z() : 0};
    }
    copy.centre = body.snap(copy.centre);
    const Vec3d along = copy.scale * ratio * axis;
    // A capsule is in a convex body if both end balls are.
    const double radius =
        std::min(inside.clearance(copy.centre + along), inside.clearance(copy.centre - along)) -
        8 * epsilon * body.size;
    const double volume = radius > 0 ? radius * radius * (2 * along.norm() + 4.0 / 3 * radius) : -1;
    if (volume > greatest) {
      greatest = volume;
      best.shape.radius = radius;
      best.shape.half_length = copy.scale * ratio;
      best.pose.translation = copy.centre;
      const Vec3d x = axes.col((k + 1) % 3);
      best.pose.rotation << x, axis.cross(x).normalized(), axis;
    }
    return volume;
  };
  for (int k = 0; k < 3; ++k) {
    double ratio = 0, at = consider(k, 0);
    for (double tried : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0}) {
      const double volume = consider(k, tried);
      if (!(volume > at)) continue;
      at = volume;
      ratio = tried;
    }
    for (double step = 1.4; step > 1.01; step = std::sqrt(step)) {
      for (double tried : {ratio / step, ratio * step}) {
        const double volume = consider(k, tried);
        if (!(volume > at)) continue;
        at = volume;
        ratio = tried;
      }
    }
  }
  if (!(greatest > 0)) {
    throw base::InputError("no capsule is certainly inside the body; expected a thicker one");
  }
  return best;
}

Part inner_reduced_hull(const LocalBody& body, int vertices) {
  const Inside inside = inside_of(body);
  if (body.shape.kind == ShapeKind::hull) {
    return hull_part(farthest_vertices(body.shape.hull->vertices, vertices));
  }
  std::vector<Vec3d> chosen =
      farthest_vertices(geometry::as_polytope(body.shape, 3).hull->vertices, vertices);
  const geometry::Copy copy = copy_inside(body, inside, chosen);
  for (Vec3d& v : chosen) v = copy.centre + copy.scale * v;
  return hull_part(chosen);
}

Part inner_icosphere(const LocalBody& body, int level) {
  const Inside inside = inside_of(body);
  std::vector<Vec3d> corners = geometry::as_polytope(body.shape, level).hull->vertices;
  for (double less = 0x1p-50; less < 0x1p-8; less *= 2) {
    std::vector<Vec3d> drawn_in;
    for (const Vec3d& v : corners) {
      drawn_in.push_back(inside.deepest() + (1 - less) * (v - inside.deepest()));
    }
    const bool fits = std::all_of(drawn_in.begin(), drawn_in.end(),
                                  [&](const Vec3d& v) { return inside.clearance(v) >= 0; });
    if (fits) return hull_part(drawn_in);
  }
  throw base::InputError("no polytope is certainly inside the body; expected a thicker one");
}

}  // namespace touchstone::proxies
