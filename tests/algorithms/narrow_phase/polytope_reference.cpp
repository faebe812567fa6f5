#include "tests/algorithms/narrow_phase/polytope_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace touchstone::reference {
namespace {

Real3 wide(const Vec3d& x) { return x.cast<Real>(); }

// The vertices of the body's core, less `origin`.
std::vector<Real3> core_vertices(const Body& body, const Vec3d& origin) {
  std::vector<Vec3d> local;
  const Shape& shape = body.shape;
  switch (shape.kind) {
    case ShapeKind::sphere: local = {Vec3d::Zero()}; break;
    case ShapeKind::capsule: local = {{0, 0, -shape.half_length}, {0, 0, shape.half_length}}; break;
    case ShapeKind::hull: local = shape.hull->vertices; break;
    case ShapeKind::box:
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3d signs{corner & 1 ? 1. : -1., corner & 2 ? 1. : -1., corner & 4 ? 1. : -1.};
        local.push_back(signs.cwiseProduct(shape.half_extents));
      }
      break;
    default: throw std::invalid_argument("the core is no polytope");
  }
  std::vector<Real3> result;
  for (const Vec3d& v : local) {
    result.push_back(body.pose.rotation.cast<Real>() * wide(v) +
                     (wide(body.pose.translation) - wide(origin)));
  }
  return result;
}

double ball(const Body& body) {
  const bool round = body.shape.kind == ShapeKind::sphere || body.shape.kind == ShapeKind::capsule;
  return round ? body.shape.radius : 0;
}

// The cross product without the part that rounding leaves along the longer of the two: of nearly
// parallel vectors that part would be what tilts it the most.
Real3 normal_of(const Real3& e, const Real3& f) {
  const Real3& longer = e.squaredNorm() > f.squaredNorm() ? e : f;
  const Real3 n = e.cross(f);
  return longer.squaredNorm() > 0 ? Real3(n - n.dot(longer) / longer.squaredNorm() * longer) : n;
}

struct Nearest {
  Real distance = std::numeric_limits<Real>::infinity();
  Real3 difference = Real3::Zero();  // from a to b
  void offer(const Real3& candidate) {
    const Real length = candidate.norm();
    if (length < distance) *this = {length, candidate};
  }
};

void offer_point_segment(const Real3& p, const Real3& q0, const Real3& q1, Real sign,
                         Nearest& nearest) {
  const Real3 e = q1 - q0;
  const Real t = e.squaredNorm() > 0
                     ? std::clamp((p - q0).dot(e) / e.squaredNorm(), Real{0}, Real{1})
                     : Real{0};
  nearest.offer(sign * (q0 + t * e - p));
}

// Offers the nearest points of the two lines if they lie within the segments; ends are offered as
// points.
void offer_segments(const Real3& p0, const Real3& p1, const Real3& q0, const Real3& q1,
                    Nearest& nearest) {
  const Real3 e = p1 - p0;
  const Real3 f = q1 - q0;
  const Real3 n = normal_of(e, f);
  const Real nn = n.squaredNorm();
  if (!(nn > 1e-30L * e.squaredNorm() * f.squaredNorm())) return;
  const Real3 between = q0 - p0;
  const Real s = between.cross(f).dot(n) / nn;
  const Real t = between.cross(e).dot(n) / nn;
  if (s < 0 || s > 1 || t < 0 || t > 1) return;
  nearest.offer(n.dot(between) / nn * n);
}

void offer_point_triangle(const Real3& p, const Real3& a, const Real3& b, const Real3& c, Real sign,
                          Nearest& nearest) {
  const Real3 e = b - a;
  const Real3 f = c - a;
  const Real3 n = normal_of(e, f);
  const Real nn = n.squaredNorm();
  if (!(nn > 1e-30L * e.squaredNorm() * f.squaredNorm())) return;
  const Real3 q = p - a;
  const Real u = q.cross(f).dot(n) / nn;
  const Real v = e.cross(q).dot(n) / nn;
  if (u < 0 || v < 0 || u + v > 1) return;
  nearest.offer(-sign * (n.dot(q) / nn * n));
}

Nearest nearest_features(const std::vector<Real3>& a, const std::vector<Real3>& b) {
  Nearest nearest;
  for (const Real3& p : a) {
    for (const Real3& q : b) nearest.offer(q - p);
  }
  const auto one_way = [&](const std::vector<Real3>& from, const std::vector<Real3>& to,
                           Real sign) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      for (std::size_t j = i + 1; j < to.size(); ++j) {
        for (const Real3& p : from) offer_point_segment(p, to[i], to[j], sign, nearest);
        for (std::size_t k = j + 1; k < to.size(); ++k) {
          for (const Real3& p : from) offer_point_triangle(p, to[i], to[j], to[k], sign, nearest);
        }
      }
    }
  };
  one_way(a, b, 1);
  one_way(b, a, -1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = i + 1; j < a.size(); ++j) {
      for (std::size_t k = 0; k < b.size(); ++k) {
        for (std::size_t l = k + 1; l < b.size(); ++l) {
          offer_segments(a[i], a[j], b[k], b[l], nearest);
        }
      }
    }
  }
  return nearest;
}

struct Depth {
  Real height = std::numeric_limits<Real>::infinity();  // of the difference a - b
  Real3 normal = Real3::UnitX();
};

Depth least_height(const std::vector<Real3>& a, const std::vector<Real3>& b) {
  Depth least;
  const auto offer = [&](const Real3& direction) {
    const Real length = direction.norm();
    if (!(length > 0)) return;
    for (const Real sign : {Real{1}, Real{-1}}) {
      const Real3 n = sign / length * direction;
      Real reach_a = -std::numeric_limits<Real>::infinity();
      Real reach_b = std::numeric_limits<Real>::infinity();
      for (const Real3& p : a) reach_a = std::max(reach_a, n.dot(p));
      for (const Real3& q : b) reach_b = std::min(reach_b, n.dot(q));
      if (reach_a - reach_b < least.height) least = {reach_a - reach_b, n};
    }
  };
  const auto edges = [](const std::vector<Real3>& points) {
    std::vector<Real3> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j) result.push_back(points[j] - points[i]);
    }
    return result;
  };
  const std::vector<Real3> edges_a = edges(a);
  const std::vector<Real3> edges_b = edges(b);
  const auto offer_cross = [&](const Real3& e, const Real3& f) {
    const Real3 n = normal_of(e, f);
    if (n.squaredNorm() > 1e-32L * e.squaredNorm() * f.squaredNorm()) offer(n);
  };
  for (const auto& own : {a, b}) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      for (std::size_t j = i + 1; j < own.size(); ++j) {
        for (std::size_t k = j + 1; k < own.size(); ++k) {
          offer_cross(own[j] - own[i], own[k] - own[i]);
        }
      }
    }
  }
  for (const Real3& e : edges_a) {
    for (const Real3& f : edges_b) offer_cross(e, f);
  }
  return least;
}

double extent(const Body& body) {
  double result = 0;
  for (const Real3& v : core_vertices(body, body.pose.translation)) {
    result = std::max(result, static_cast<double>(v.stableNorm()));
  }
  return result + ball(body);
}

}  // namespace

Real signed_distance(const Body& a, const Body& b, Vec3d& normal) {
  const Vec3d origin = a.pose.translation;
  const std::vector<Real3> points_a = core_vertices(a, origin);
  const std::vector<Real3> points_b = core_vertices(b, origin);
  const Real radius = Real{ball(a)} + Real{ball(b)};
  // The heights of normals do not decide overlap of points and segments; their gap does.
  const Nearest gap = nearest_features(points_a, points_b);
  const Depth depth = least_height(points_a, points_b);
  const bool solid = depth.height < std::numeric_limits<Real>::infinity();
  if (solid && depth.height > 0) {
    bool apart = false;  // a direction between vertices or along a gap may still separate them
    if (gap.distance > 0) {
      const Real3 n = gap.difference / gap.distance;
      Real reach_a = -std::numeric_limits<Real>::infinity();
      Real reach_b = std::numeric_limits<Real>::infinity();
      for (const Real3& p : points_a) reach_a = std::max(reach_a, n.dot(p));
      for (const Real3& q : points_b) reach_b = std::min(reach_b, n.dot(q));
      apart = reach_a < reach_b;
    }
    if (!apart) {
      normal = depth.normal.cast<double>();
      return -(depth.height + radius);
    }
  }
  normal = (gap.difference / gap.distance).cast<double>();
  return gap.distance - radius;
}

double pair_size(const Body& a, const Body& b) {
  return std::max({extent(a), extent(b), (b.pose.translation - a.pose.translation).stableNorm()});
}

double outside_by(const Body& body, const Vec3d& point) {
  const Shape& s = body.shape;
  const Vec3d x = body.pose.rotation.transpose() * (point - body.pose.translation);
  const double off_axis = std::hypot(x.x(), x.y());
  switch (s.kind) {
    case ShapeKind::sphere: return std::max(0., x.norm() - s.radius);
    case ShapeKind::capsule:
      return std::max(
          0.,
          (x - Vec3d{0, 0, std::clamp(x.z(), -s.half_length, s.half_length)}).norm() - s.radius);
    case ShapeKind::box: return (x.cwiseAbs() - s.half_extents).cwiseMax(0).norm();
    case ShapeKind::cylinder:
      return std::hypot(std::max(0., std::abs(x.z()) - s.half_length),
                        std::max(0., off_axis - s.radius));
    case ShapeKind::cone: {
      const double slope = std::hypot(s.radius, 2 * s.half_length);
      const double over_side =
          ((x.z() - s.half_length) * s.radius + off_axis * 2 * s.half_length) / slope;
      return std::max({0., -s.half_length - x.z(), over_side});
    }
    case ShapeKind::ellipsoid:
      return std::max(0., x.cwiseQuotient(s.radii).norm() - 1) * s.radii.minCoeff();
    case ShapeKind::halfspace: return std::max(0., (s.normal.dot(x) - s.offset) / s.normal.norm());
    case ShapeKind::hull: break;
  }
  throw std::invalid_argument("no membership test for a hull");
}

Outcome query(NarrowPhase& algorithm, Task task, const Body& a, const Body& b) {
  const bool swapped = a.shape.kind > b.shape.kind;
  const Body& first = swapped ? b : a;
  const Body& second = swapped ? a : b;
  const std::array<Shape, 2> shapes = {first.shape, second.shape};
  const std::array<Pose, 2> poses = {first.pose, second.pose};
  const std::array<std::uint32_t, 2> numbers = {0, 1};
  const std::span<const std::uint32_t> bodies(numbers);
  algorithm.bind(shapes);
  Outcome outcome;
  algorithm.solve(task,
                  {.kind_a = first.shape.kind,
                   .kind_b = second.shape.kind,
                   .pairs = {.first = bodies.subspan(0, 1),
                             .second = bodies.subspan(1, 1),
                             .shape_of = bodies,
                             .poses = poses}},
                  {&outcome, 1});
  if (swapped) {
    outcome.normal = -outcome.normal;
    std::swap(outcome.witness_a, outcome.witness_b);
  }
  return outcome;
}

}  // namespace touchstone::reference
