// Moves a body near the origin and to unit size, exactly; proves containment with bounds on the
// rounding.
#include "harness/proxies/local_body.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/bounds.h"
#include "algorithms/core/double_double.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/optimal_fits.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::proxies {
namespace {

Vec3d scaled(const Vec3d& v, int exponent) {
  return {std::ldexp(v.x(), exponent), std::ldexp(v.y(), exponent), std::ldexp(v.z(), exponent)};
}

Vec3d half_extents(const Shape& s) {
  switch (s.kind) {
    case ShapeKind::sphere: return Vec3d::Constant(s.radius);
    case ShapeKind::capsule:
      return {s.radius, s.radius, (s.half_length + s.radius) * (1 + epsilon)};
    case ShapeKind::cylinder:
    case ShapeKind::cone: return {s.radius, s.radius, s.half_length};
    case ShapeKind::box: return s.half_extents;
    case ShapeKind::ellipsoid: return s.radii;
    default: return Vec3d::Zero();
  }
}

// The exponent that scales to about 1; 0 for a body without size.
int exponent_of(const Vec3d& v) {
  const double greatest = v.maxCoeff();
  return greatest > 0 ? std::ilogb(greatest) : 0;
}

}  // namespace

Shape scaled(Shape shape, int exponent) {
  shape.radius = std::ldexp(shape.radius, exponent);
  shape.half_length = std::ldexp(shape.half_length, exponent);
  shape.half_extents = scaled(shape.half_extents, exponent);
  shape.radii = scaled(shape.radii, exponent);
  if (shape.hull != nullptr) {
    auto hull = std::make_shared<Hull>(*shape.hull);
    for (Vec3d& v : hull->vertices) v = scaled(v, exponent);
    shape.hull = std::move(hull);
  }
  return shape;
}

LocalBody::LocalBody(const Shape& body, const geometry::Mesh* with) : has_mesh(with != nullptr) {
  if (body.kind != ShapeKind::hull) {
    half = half_extents(body);
    exponent_ = exponent_of(half);
    shape = scaled(body, -exponent_);
    half = half_extents(shape);
    size = half.norm() * (1 + 4 * epsilon);
    solid = half.minCoeff() > 0;
    return;
  }
  points = body.hull->vertices;
  if (has_mesh) points.insert(points.end(), with->vertices.begin(), with->vertices.end());
  Vec3d low = points.front(), high = low;
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3d extent = 0.5 * high - 0.5 * low;
  for (int k = 0; k < 3; ++k) {
    const double at = points.front()[k];
    if (std::abs(at) > 8 * extent[k]) shift_[k] = at;
  }
  exponent_ = exponent_of(extent) + 1;
  const auto local = [&](const Vec3d& p) { return scaled(Vec3d(p - shift_), -exponent_); };
  for (Vec3d& p : points) p = local(p);
  auto hull = std::make_shared<Hull>(*body.hull);
  for (Vec3d& v : hull->vertices) v = local(v);
  solid = hull->dimension == 3;
  shape = body;
  shape.hull = std::move(hull);
  if (has_mesh) {
    mesh.triangles = with->triangles;
    for (const Vec3d& v : with->vertices) mesh.vertices.push_back(local(v));
  }
  low = high = points.front();
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  middle = snap(0.5 * (low + high));
  // The exact difference is at most half a unit in the last place larger.
  half = (high - middle).cwiseMax(middle - low) * (1 + epsilon);
  for (const Vec3d& p : points) size = std::max(size, (p - middle).norm() * (1 + 8 * epsilon));
}

Vec3d LocalBody::snap(const Vec3d& centre) const {
  const Vec3d given = shift_ + scaled(centre, exponent_);
  return scaled(Vec3d(given - shift_), -exponent_);
}

Part LocalBody::placed(Part part) const {
  part.shape = scaled(std::move(part.shape), exponent_);
  part.pose.translation = shift_ + scaled(part.pose.translation, exponent_);
  return part;
}

Part LocalBody::localised(Part part) const {
  part.shape = scaled(std::move(part.shape), -exponent_);
  part.pose.translation = scaled(Vec3d(part.pose.translation - shift_), -exponent_);
  return part;
}

double LocalBody::length_as_given(double length) const { return std::ldexp(length, exponent_); }

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
