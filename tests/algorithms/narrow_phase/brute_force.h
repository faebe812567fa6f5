// The reference for algorithms that use faces and edges: signed distances of boxes and hulls over
// the shapes' own features, with every axis and every pair, in long double. Fast enough for
// thousands of pairs in each of many algorithms; the verdict needs bodies whose difference is
// solid. polytope_reference.h goes by vertices alone, and also knows spheres, capsules and normals.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::brute_force {

using Real = long double;
using Vec = Eigen::Matrix<Real, 3, 1>;

struct Edge {
  Vec tail, head;
};
struct Triangle {
  Vec a, b, c;
};

// A body in the world, relative to some origin. `axes` are outward face normals.
struct Body {
  std::vector<Vec> vertices, axes;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
};

inline void add_triangle(Body& body, const Vec& a, const Vec& b, const Vec& c) {
  body.triangles.push_back({a, b, c});
  const Vec normal = (b - a).cross(c - a);
  if (!(normal.norm() > 0)) return;
  // The axis is tried both ways, so that its outward side need not be known.
  body.axes.push_back(normal.normalized());
  body.axes.push_back(-normal.normalized());
}

inline Body place(const Shape& shape, const Pose& pose, const Vec3d& origin) {
  const Eigen::Matrix<Real, 3, 3> m = pose.rotation.cast<Real>();
  const Vec t = pose.translation.cast<Real>() - origin.cast<Real>();
  Body body;
  const auto world = [&](const Vec3d& v) { return Vec(m * v.cast<Real>() + t); };
  if (shape.kind == ShapeKind::box) {
    for (int k = 0; k < 8; ++k) {
      const Vec3d sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
      body.vertices.push_back(world(sign.cwiseProduct(shape.half_extents)));
    }
    for (int axis = 0; axis < 3; ++axis) {
      // A face of a box may have no area: its normal is that of the matrix.
      const Vec normal = m.col((axis + 1) % 3).cross(m.col((axis + 2) % 3)).normalized();
      body.axes.push_back(normal);
      body.axes.push_back(-normal);
      const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      for (const int base : {0, 1 << axis}) {
        const Vec &p = body.vertices[base], &q = body.vertices[base + u],
                  &r = body.vertices[base + u + v], &s = body.vertices[base + v];
        body.triangles.push_back({p, q, r});
        body.triangles.push_back({p, r, s});
      }
      for (const int base : {0, u, v, u + v}) {
        body.edges.push_back({body.vertices[base], body.vertices[base + (1 << axis)]});
      }
    }
    return body;
  }
  const Hull& hull = *shape.hull;
  for (const Vec3d& v : hull.vertices) body.vertices.push_back(world(v));
  const std::size_t n = body.vertices.size();
  if (hull.dimension == 3) {
    for (const Hull::Face& face : hull.faces) {
      for (std::size_t k = 1; k + 1 < face.loop.size(); ++k) {
        add_triangle(body, body.vertices[face.loop[0]], body.vertices[face.loop[k]],
                     body.vertices[face.loop[k + 1]]);
      }
    }
    for (const Hull::Edge& edge : hull.edges) {
      body.edges.push_back({body.vertices[edge.tail], body.vertices[edge.head]});
    }
    return body;
  }
  // Flat sets are small: every pair is an edge, every triple a face.
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      body.edges.push_back({body.vertices[i], body.vertices[j]});
      for (std::size_t k = j + 1; k < n; ++k) {
        const Vec &a = body.vertices[i], &b = body.vertices[j], &c = body.vertices[k];
        add_triangle(body, a, b, c);
        const Vec normal = (b - a).cross(c - a);
        for (const Vec& along : {Vec(b - a), Vec(c - b), Vec(a - c)}) {
          const Vec side = along.cross(normal);
          if (side.norm() > 0) {
            body.axes.push_back(side.normalized());
            body.axes.push_back(-side.normalized());
          }
        }
      }
    }
  }
  return body;
}

inline Real gap_along(const Body& a, const Body& b, const Vec& normal) {
  Real furthest = -std::numeric_limits<Real>::infinity();
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Vec& v : a.vertices) furthest = std::max(furthest, normal.dot(v));
  for (const Vec& v : b.vertices) nearest = std::min(nearest, normal.dot(v));
  return nearest - furthest;
}

// The greatest gap over all axes: its sign is the verdict (of bodies whose difference is solid),
// and where it is negative it is minus the penetration depth.
inline Real greatest_gap(const Body& a, const Body& b) {
  Real best = -std::numeric_limits<Real>::infinity();
  for (const Vec& axis : a.axes) best = std::max(best, gap_along(a, b, axis));
  for (const Vec& axis : b.axes) best = std::max(best, gap_along(a, b, axis));
  for (const Edge& p : a.edges) {
    const Vec along = (p.head - p.tail).normalized();
    if (!(along.norm() > 0.5L)) continue;
    for (const Edge& q : b.edges) {
      const Vec other = (q.head - q.tail).normalized();
      if (!(other.norm() > 0.5L)) continue;
      Vec axis = along.cross(other);
      if (!(axis.norm() > 1e-17L)) continue;
      axis.normalize();
      axis = (axis - axis.dot(along) * along).normalized();
      best = std::max({best, gap_along(a, b, axis), gap_along(a, b, -axis)});
    }
  }
  return best;
}

inline Real distance(const Vec& point, const Edge& edge) {
  const Vec along = edge.head - edge.tail;
  const Real square = along.squaredNorm();
  const Real s = square > 0 ? std::clamp<Real>(along.dot(point - edge.tail) / square, 0, 1) : 0;
  return (point - edge.tail - s * along).norm();
}

inline Real distance(const Vec& point, const Triangle& t) {
  Real best = std::min({distance(point, Edge{t.a, t.b}), distance(point, Edge{t.b, t.c}),
                        distance(point, Edge{t.c, t.a})});
  const Vec normal = (t.b - t.a).cross(t.c - t.a);
  if (!(normal.norm() > 0)) return best;
  const auto beside = [&](const Vec& p, const Vec& q) {
    return (q - p).cross(point - p).dot(normal) >= 0;
  };
  if (beside(t.a, t.b) && beside(t.b, t.c) && beside(t.c, t.a)) {
    best = std::min(best, std::abs(normal.normalized().dot(point - t.a)));
  }
  return best;
}

inline Real distance(const Edge& p, const Edge& q) {
  Real best = std::min(
      {distance(p.tail, q), distance(p.head, q), distance(q.tail, p), distance(q.head, p)});
  const Vec d = p.head - p.tail, e = q.head - q.tail, between = q.tail - p.tail;
  const Vec across = d.cross(e);
  const Real square = across.squaredNorm();
  if (!(square > 0)) return best;
  const Real s = between.cross(e).dot(across) / square, t = between.cross(d).dot(across) / square;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
    best = std::min(best, (between + t * e - s * d).norm());
  }
  return best;
}

// The distance of bodies that are apart.
inline Real distance(const Body& a, const Body& b) {
  Real best = std::numeric_limits<Real>::infinity();
  for (const Vec& p : a.vertices) {
    for (const Vec& q : b.vertices) best = std::min(best, (p - q).norm());
    for (const Triangle& t : b.triangles) best = std::min(best, distance(p, t));
    for (const Edge& e : b.edges) best = std::min(best, distance(p, e));
  }
  for (const Vec& q : b.vertices) {
    for (const Triangle& t : a.triangles) best = std::min(best, distance(q, t));
    for (const Edge& e : a.edges) best = std::min(best, distance(q, e));
  }
  for (const Edge& p : a.edges) {
    for (const Edge& q : b.edges) best = std::min(best, distance(p, q));
  }
  return best;
}

// Metres; > 0 the distance, < 0 minus the penetration depth.
inline double signed_distance(const Shape& a, const Pose& pose_a, const Shape& b,
                              const Pose& pose_b) {
  const Body body_a = place(a, pose_a, pose_a.translation);
  const Body body_b = place(b, pose_b, pose_a.translation);
  const Real gap = greatest_gap(body_a, body_b);
  return static_cast<double>(gap > 0 ? distance(body_a, body_b) : gap);
}

// The distance of a point in the world from a box or solid hull; <= 0 inside.
inline double outside(const Shape& shape, const Pose& pose, const Vec3d& point) {
  const Body body = place(shape, pose, point);
  Body at;
  at.vertices.push_back(Vec::Zero());
  return static_cast<double>(greatest_gap(body, at));
}

}  // namespace touchstone::brute_force
