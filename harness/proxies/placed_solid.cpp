// Distances, volumes and extreme points of convex solids; splits a body into convex solids and
// closed surfaces.
#include "harness/proxies/placed_solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "harness/geometry/tessellation.h"
#include "harness/proxies/local_body.h"
#include "harness/proxies/union_volume.h"

namespace touchstone::proxies {
namespace {

using Interval = std::optional<std::pair<double, double>>;

Interval both(const Interval& a, const Interval& b) {
  if (!a || !b) return std::nullopt;
  const double low = std::max(a->first, b->first), high = std::min(a->second, b->second);
  if (low > high) return std::nullopt;
  return std::pair(low, high);
}

Interval either(const Interval& a, const Interval& b) {
  if (!a || !b) return a ? a : b;
  return std::pair(std::min(a->first, b->first), std::max(a->second, b->second));
}

// The interval of t with |from + t by| <= radius, in any dimension.
template <class Vector>
Interval in_ball(const Vector& from, const Vector& by, double radius) {
  const double a = by.squaredNorm(), b = from.dot(by), c = from.squaredNorm() - radius * radius;
  if (!(a > 0)) return c <= 0 ? Interval({-infinity, infinity}) : std::nullopt;
  const double root = b * b - a * c;
  if (root < 0) return std::nullopt;
  return std::pair((-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a);
}

Interval in_slab(double from, double by, double half) {
  if (by == 0) return std::abs(from) <= half ? Interval({-infinity, infinity}) : std::nullopt;
  const double a = (-half - from) / by, b = (half - from) / by;
  return std::pair(std::min(a, b), std::max(a, b));
}

// Signed distance from p to the ellipsoid, whose semi-axes are positive. It maximises Lagrange's
// dual, which is concave in its multiplier.
double ellipsoid_distance(const Vec3d& radii, const Vec3d& p) {
  const Vec3d squares = radii.cwiseAbs2();
  const bool inside = p.cwiseQuotient(radii).squaredNorm() <= 1;
  const auto slope = [&](double m) {
    return p.cwiseAbs2()
               .cwiseProduct(squares)
               .cwiseQuotient((squares.array() + m).square().matrix())
               .sum() -
           1;
  };
  double low = inside ? -squares.minCoeff() * (1 - 1e-15) : 0;
  double high = inside ? 0 : p.norm() * radii.maxCoeff() + squares.maxCoeff();
  for (int step = 0; step < 100; ++step) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0 ? low : high) = middle;
  }
  const double m = 0.5 * (low + high);
  const double square = m * (p.cwiseAbs2().cwiseQuotient((squares.array() + m).matrix()).sum() - 1);
  return (inside ? -1 : 1) * std::sqrt(std::max(0.0, square));
}

// Distance to a convex polygon in the half-plane x >= 0, anticlockwise, with the last edge along x
// = 0.
double profile_distance(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& x) {
  double inside = -infinity, outside = (x - corners.front()).norm();
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Eigen::Vector2d edge = corners[i + 1] - corners[i], from = x - corners[i];
    const double length = edge.norm();
    if (!(length > 0)) continue;
    inside = std::max(inside, (edge.y() * from.x() - edge.x() * from.y()) / length);
    const double t = std::clamp(from.dot(edge) / (length * length), 0.0, 1.0);
    outside = std::min(outside, (from - t * edge).norm());
  }
  return inside > 0 || inside == -infinity ? outside : inside;
}

}  // namespace

PlacedSolid::PlacedSolid(const Shape& shape, const Pose& pose, const Mat3d& turn)
    : shape_(shape), pose_{turn * pose.rotation, turn * pose.translation} {
  Shape near = shape;
  switch (shape.kind) {
    case ShapeKind::halfspace:
      throw base::InputError("a half-space has no size; expected a bounded shape");
    case ShapeKind::sphere:
      extremes_ = {pose_.translation};
      radius_ = shape.radius;
      break;
    case ShapeKind::capsule:
      for (double end : {-1.0, 1.0}) extremes_.push_back(pose_({0, 0, end * shape.half_length}));
      radius_ = shape.radius;
      break;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      for (double end : {-1.0, 1.0}) {
        if (end > 0 && shape.kind == ShapeKind::cone) {
          extremes_.push_back(pose_({0, 0, shape.half_length}));
          continue;
        }
        for (int i = 0; i < 512; ++i) {
          const double angle = 2 * std::numbers::pi * i / 512;
          extremes_.push_back(rounded({std::cos(angle), std::sin(angle), 0}, end));
        }
      }
      break;
    case ShapeKind::ellipsoid:
      for (const Vec3d& p : geometry::as_polytope(shape, 4).hull->vertices)
        extremes_.push_back(pose_(p));
      break;
    case ShapeKind::box:
    case ShapeKind::hull: polytope_ = true;
  }
  near = geometry::as_polytope(shape, 3);
  if (polytope_ && shape.kind == ShapeKind::box && shape.half_extents.minCoeff() == 0) {
    near.hull = make_reduced_hull(near.hull->vertices);  // a flat box
  }
  auto hull = std::make_shared<Hull>(*near.hull);
  for (Vec3d& v : hull->vertices) v = pose_(v);
  if (polytope_ && hull->dimension == 3 && hull->faces.empty()) {
    throw base::InputError("the faces of a hull are not known; expected one that is no sliver");
  }
  if (polytope_) extremes_ = hull->vertices;
  std::vector<geometry::Triangle> triangles = geometry::triangles_of(*hull);
  if (polytope_ && hull->dimension == 3) {
    for (const geometry::Triangle& t : triangles) {
      const Vec3d n = t.normal();
      if (n.norm() > 0) planes_.push_back({n.normalized(), n.normalized().dot(t.a)});
    }
  }
  surface_ = geometry::Surface(std::move(triangles));
  volume_ = own_volume();
  low_ = high_ = extremes_.front();
  for (const Vec3d& p : extremes_) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  low_.array() -= radius_;
  high_.array() += radius_;
}

Vec3d PlacedSolid::rounded(const Vec3d& direction, double end) const {
  if (shape_.kind == ShapeKind::ellipsoid) return pose_(shape_.radii.cwiseProduct(direction));
  const Vec3d out = Vec3d(direction.x(), direction.y(), 0).normalized();
  return pose_(shape_.radius * out + Vec3d(0, 0, end * shape_.half_length));
}

double PlacedSolid::own_volume() const {
  const double r = shape_.radius, length = 2 * shape_.half_length;
  constexpr double pi = std::numbers::pi;
  switch (shape_.kind) {
    case ShapeKind::sphere: return 4.0 / 3 * pi * r * r * r;
    case ShapeKind::capsule: return pi * r * r * (length + 4.0 / 3 * r);
    case ShapeKind::cylinder: return pi * r * r * length;
    case ShapeKind::cone: return pi * r * r * length / 3;
    case ShapeKind::ellipsoid: return 4.0 / 3 * pi * shape_.radii.prod();
    case ShapeKind::box: return 8 * shape_.half_extents.prod();
    default: return planes_.empty() ? 0 : std::max(0.0, geometry::volume_of(surface()));
  }
}

double PlacedSolid::signed_distance(const Vec3d& x) const {
  const Vec3d p = local(x);
  const double beside = std::hypot(p.x(), p.y()), r = shape_.radius, h = shape_.half_length;
  switch (shape_.kind) {
    case ShapeKind::sphere: return p.norm() - r;
    case ShapeKind::capsule: return std::hypot(beside, std::max(0.0, std::abs(p.z()) - h)) - r;
    case ShapeKind::box: {
      const Vec3d out = p.cwiseAbs() - shape_.half_extents;
      return out.maxCoeff() <= 0 ? out.maxCoeff() : out.cwiseMax(0.0).norm();
    }
    case ShapeKind::cylinder:
      return profile_distance({{0, -h}, {r, -h}, {r, h}, {0, h}}, {beside, p.z()});
    case ShapeKind::cone: return profile_distance({{0, -h}, {r, -h}, {0, h}}, {beside, p.z()});
    case ShapeKind::ellipsoid:
      if (shape_.radii.minCoeff() > 0) return ellipsoid_distance(shape_.radii, p);
      break;
    default: break;
  }
  double beyond = -infinity;
  for (const geometry::Plane& plane : planes_)
    beyond = std::max(beyond, plane.normal.dot(x) - plane.offset);
  return !planes_.empty() && beyond <= 0 ? beyond : surface_.distance(x);
}

geometry::SurfacePoint PlacedSolid::way_out(const Vec3d& x) const {
  const auto beyond = [&](const geometry::Plane& plane) {
    return plane.normal.dot(x) - plane.offset;
  };
  const geometry::Plane& nearest = *std::max_element(
      planes_.begin(), planes_.end(),
      [&](const geometry::Plane& a, const geometry::Plane& b) { return beyond(a) < beyond(b); });
  return {x - beyond(nearest) * nearest.normal, nearest.normal};
}

std::optional<std::pair<double, double>> PlacedSolid::along_z(double x, double y) const {
  if (!polytope_) {
    return along_line(local({x, y, 0}), pose_.rotation.transpose() * Vec3d::UnitZ());
  }
  if (planes_.empty()) return std::nullopt;
  double low = -infinity, high = infinity;
  for (const geometry::Plane& p : planes_) {
    const double rest = p.offset - p.normal.x() * x - p.normal.y() * y;
    if (p.normal.z() > 0) {
      high = std::min(high, rest / p.normal.z());
    } else if (p.normal.z() < 0) {
      low = std::max(low, rest / p.normal.z());
    } else if (rest < 0) {
      return std::nullopt;
    }
  }
  if (low > high) return std::nullopt;
  return std::pair(low, high);
}

std::optional<std::pair<double, double>> PlacedSolid::along_line(const Vec3d& from,
                                                                 const Vec3d& by) const {
  const double r = shape_.radius, h = shape_.half_length;
  const Interval slab = in_slab(from.z(), by.z(), h);
  const Interval round = in_ball<Eigen::Vector2d>(from.head<2>(), by.head<2>(), r);
  switch (shape_.kind) {
    case ShapeKind::sphere: return in_ball(from, by, r);
    case ShapeKind::cylinder: return both(slab, round);
    case ShapeKind::capsule: {
      const Vec3d end(0, 0, h);
      return either(both(slab, round),
                    either(in_ball<Vec3d>(from - end, by, r), in_ball<Vec3d>(from + end, by, r)));
    }
    case ShapeKind::ellipsoid:
      if (!(shape_.radii.minCoeff() > 0)) return std::nullopt;
      return in_ball<Vec3d>(from.cwiseQuotient(shape_.radii), by.cwiseQuotient(shape_.radii), 1);
    case ShapeKind::cone: {
      if (!slab || !(h > 0)) return std::nullopt;
      // The condition within the slab is beside <= k (h - z), with both sides squared.
      const double k = r / (2 * h), up = k * (h - from.z()), less = -k * by.z();
      const double a = by.head<2>().squaredNorm() - less * less;
      const double b = from.head<2>().dot(by.head<2>()) - up * less;
      const double c = from.head<2>().squaredNorm() - up * up;
      if (a == 0) {
        if (b == 0) return c <= 0 ? slab : std::nullopt;
        const double root = -c / (2 * b);
        return both(slab, b > 0 ? std::pair(-infinity, root) : std::pair(root, infinity));
      }
      const double square = b * b - a * c;
      if (square < 0) return a > 0 ? std::nullopt : slab;
      const double one = (-b - std::sqrt(square)) / a, other = (-b + std::sqrt(square)) / a;
      const double low = std::min(one, other), high = std::max(one, other);
      if (a > 0) return both(slab, std::pair(low, high));
      const Interval below = both(slab, std::pair(-infinity, low));
      const Interval above = both(slab, std::pair(high, infinity));
      if (!below || !above) return below ? below : above;
      return below->second - below->first > above->second - above->first ? below : above;
    }
    default: return std::nullopt;
  }
}

WholeBody::WholeBody(const LocalBody& body, const Mat3d& turn) {
  if (body.mesh.triangles.empty()) {
    convex.emplace_back(body.shape, Pose{}, turn);
    surface = convex.front().surface();
    return;
  }
  for (geometry::MeshPiece& piece : geometry::pieces_of(body.mesh)) {
    for (Vec3d& v : piece.mesh.vertices) v = turn * v;
    std::vector<geometry::Triangle> triangles = geometry::triangles_of(piece.mesh);
    surface.insert(surface.end(), triangles.begin(), triangles.end());
    if (piece.closed) {
      closed.insert(closed.end(), triangles.begin(), triangles.end());
      continue;
    }
    Shape hull;
    hull.kind = ShapeKind::hull;
    hull.hull = make_reduced_hull(piece.mesh.vertices);
    convex.emplace_back(hull, Pose{});
  }
}

double WholeBody::volume() const {
  if (closed.empty() && convex.size() == 1) return convex.front().volume();
  return overlap_of(convex, closed, {}).body;
}

}  // namespace touchstone::proxies
