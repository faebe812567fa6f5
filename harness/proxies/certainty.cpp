// Containment of one convex body in another, proven with bounds on the rounding.
#include "harness/proxies/certainty.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/double_double.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/greatest_copy.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::proxies {
namespace {

// The triangle's normal, correct to its last digit however thin the triangle is.
Vec3d true_normal(const geometry::Triangle& t) {
  return cross(DoubleDouble3::difference(t.b, t.a), DoubleDouble3::difference(t.c, t.a)).value();
}

// Bounds the rounding of normal . (x - a) for |x - a| = 1: of the normal, of the difference, and of
// the sum of three products, with a margin.
double rounding_of(const geometry::Triangle& t, const Vec3d& normal) {
  return 16 * epsilon * normal.norm() + 0x1p-96 * (t.b - t.a).norm() * (t.c - t.a).norm();
}

// An upper bound on the distance of the body's points from a.
double span_from(const LocalBody& body, const Vec3d& a) {
  return (body.size + (a - body.middle).norm()) * (1 + 8 * epsilon);
}

double ellipsoid_clearance(const Vec3d& radii, const Vec3d& p) {
  const auto gauge = [&](double m) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      if (p[k] != 0) sum += p[k] * p[k] / (radii[k] * radii[k] - m);
    }
    return sum;
  };
  if (!(gauge(0) < 1 - 16 * epsilon)) return -1;
  // Lagrange's dual of the least |x - p|^2 with x on the surface: every m gives a lower bound.
  double low = 0, high = radii.minCoeff() * radii.minCoeff() * (1 - 4 * epsilon);
  const auto bound = [&](double m) { return m * (1 - gauge(m)); };
  double best = bound(high);
  for (int step = 0; step < 100; ++step) {
    const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
    const double at_a = bound(a), at_b = bound(b);
    best = std::max({best, at_a, at_b});
    (at_a < at_b ? low : high) = at_a < at_b ? a : b;
  }
  return std::sqrt(std::max(0.0, best)) - 32 * epsilon * radii.maxCoeff();
}

// The clearance for shapes other than hulls.
double round_clearance(const Shape& s, const Vec3d& x) {
  const double slack = 16 * epsilon * (s.radius + s.half_length + x.cwiseAbs().maxCoeff());
  const double beside = std::hypot(x.x(), x.y());
  switch (s.kind) {
    case ShapeKind::sphere: return s.radius - x.norm() - slack;
    case ShapeKind::capsule: {
      const double above = std::max(0.0, std::abs(x.z()) - s.half_length);
      return s.radius - std::hypot(beside, above) - slack;
    }
    case ShapeKind::box: return (s.half_extents - x.cwiseAbs()).minCoeff() * (1 - epsilon);
    case ShapeKind::cylinder:
      return std::min(s.radius - beside, s.half_length - std::abs(x.z())) - slack;
    case ShapeKind::cone: {
      const double side = (s.radius * (s.half_length - x.z()) - 2 * s.half_length * beside) /
                          std::hypot(s.radius, 2 * s.half_length);
      return std::min(x.z() + s.half_length, side) - slack;
    }
    case ShapeKind::ellipsoid: return ellipsoid_clearance(s.radii, x);
    case ShapeKind::hull:
    case ShapeKind::halfspace: break;
  }
  return -infinity;
}

}  // namespace

double reach(const LocalBody& body, const Vec3d& n, const Vec3d& a) {
  const Shape& s = body.shape;
  double far = -infinity;
  if (s.kind == ShapeKind::hull) {
    for (const Vec3d& p : body.points) far = std::max(far, n.dot(p - a));
  } else {
    const double disc = s.radius * std::hypot(n.x(), n.y());
    const double along = s.half_length * std::abs(n.z());
    double extent = 0;
    switch (s.kind) {
      case ShapeKind::sphere: extent = s.radius * n.norm(); break;
      case ShapeKind::capsule: extent = along + s.radius * n.norm(); break;
      case ShapeKind::box: extent = s.half_extents.dot(n.cwiseAbs()); break;
      case ShapeKind::cylinder: extent = along + disc; break;
      case ShapeKind::cone: {
        const double tip = s.half_length * n.z();
        extent = std::max(tip, disc - tip);
        break;
      }
      default: extent = s.radii.cwiseProduct(n).norm(); break;
    }
    far = extent - n.dot(a);
  }
  return far + 16 * epsilon * n.norm() * span_from(body, a);
}

std::optional<Shape> hull_that_holds(const LocalBody& body, const std::vector<Vec3d>& points) {
  const std::shared_ptr<const Hull> first = make_reduced_hull(points);
  if (first->faces.empty()) return std::nullopt;
  Vec3d middle = Vec3d::Zero();
  for (const Vec3d& v : first->vertices) middle += v / static_cast<double>(first->vertices.size());
  double more = 0;
  for (int round = 0; round < 60; ++round) {
    auto hull = std::make_shared<Hull>(*first);
    for (Vec3d& v : hull->vertices) v = middle + (1 + more) * (v - middle);
    double beyond = -infinity;  // relative to the plane's distance from the middle
    for (const geometry::Triangle& t : geometry::triangles_of(*hull)) {
      const Vec3d n = true_normal(t);
      const double error = rounding_of(t, n) * span_from(body, t.a);
      const double height = n.dot(t.a - middle) - error;
      if (!(height > 0)) return std::nullopt;
      beyond = std::max(beyond, (reach(body, n, t.a) + error) / height);
    }
    if (beyond <= 0) {
      Shape shape;
      shape.kind = ShapeKind::hull;
      shape.hull = std::move(hull);
      return shape;
    }
    more = (1 + more) * (1 + beyond * (1 + 1e-6)) * (1 + 2 * epsilon) - 1;
  }
  return std::nullopt;
}

Inside::Inside(const LocalBody& body) : body_(body) {
  if (!body.solid) return;
  const Shape& s = body.shape;
  const Hull* hull = s.hull.get();
  Shape stand_in;
  if (s.kind != ShapeKind::hull) {
    stand_in = geometry::as_polytope(
        s, s.kind == ShapeKind::cylinder || s.kind == ShapeKind::cone ? 4 : 3);
    hull = stand_in.hull.get();
  }
  for (const geometry::Triangle& t : geometry::triangles_of(*hull)) {
    const Vec3d n = true_normal(t);
    const double length = n.norm();
    if (s.kind == ShapeKind::hull) facets_.push_back({n, t.a, length, rounding_of(t, n)});
    if (length > 0) planes_.push_back({n / length, n.dot(t.a) / length});
  }
  if (planes_.empty()) return;
  if (s.kind == ShapeKind::hull) {
    const geometry::Copy ball = geometry::greatest_copy(
        planes_, [](const Vec3d& n) { return n.norm(); }, body.middle, 2 * body.size);
    deepest_ = body.snap(ball.centre);
  } else if (s.kind == ShapeKind::cone) {
    const double slant = std::hypot(s.radius, 2 * s.half_length);
    const double radius = s.radius * 2 * s.half_length / (s.radius + slant);
    deepest_ = body.snap({0, 0, radius - s.half_length});
  }
  has_interior_ = clearance(deepest_) > 0;
}

double Inside::clearance(const Vec3d& x) const {
  if (body_.shape.kind != ShapeKind::hull) return round_clearance(body_.shape, x);
  return facets_.empty() ? -infinity : within_facets(x);
}

double Inside::within_facets(const Vec3d& x) const {
  double least = infinity;
  for (const Facet& f : facets_) {
    const Vec3d from = f.point - x;
    const double height = f.normal.dot(from) - f.error * from.norm();
    if (!(f.length > 0)) return -infinity;
    least = std::min(least, height / f.length);
  }
  return least * (1 - (least > 0 ? 8 : -8) * epsilon);
}

}  // namespace touchstone::proxies
