// Bodies for the narrow-phase tests, and a way to ask an algorithm about one pair.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <random>
#include <utility>
#include <vector>

#include "algorithms/narrow_phase.h"

namespace touchstone {

// Printers for the messages of failed tests.
inline void PrintTo(Answer answer, std::ostream* out) { *out << to_string(answer); }
inline void PrintTo(Status status, std::ostream* out) { *out << to_string(status); }

}  // namespace touchstone

namespace touchstone::test {

inline constexpr std::array scalars{Precision::float32, Precision::float64};

inline Shape sphere(double radius) {
  Shape shape;
  shape.radius = radius;
  return shape;
}
inline Shape box(double x, double y, double z) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = Vec3d(x, y, z);
  return shape;
}
inline Shape as_shape(std::shared_ptr<const Hull> hull) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return shape;
}

// A solid hull from its faces as loops, anticlockwise seen from outside.
inline Shape hull(std::vector<Vec3d> vertices,
                  const std::vector<std::vector<std::uint32_t>>& loops) {
  auto made = std::make_shared<Hull>();
  made->vertices = std::move(vertices);
  made->neighbours.resize(made->vertices.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_of;
  for (const auto& loop : loops) {
    Vec3d area = Vec3d::Zero();
    const Vec3d& first = made->vertices[loop[0]];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t tail = loop[k], head = loop[(k + 1) % loop.size()];
      area += (made->vertices[tail] - first).cross(made->vertices[head] - first);
      face_of[{tail, head}] = static_cast<std::uint32_t>(made->faces.size());
      made->neighbours[tail].push_back(head);
    }
    made->faces.push_back({loop, area.normalized()});
  }
  for (const auto& [ends, face] : face_of) {
    if (ends.first < ends.second) {
      made->edges.push_back({ends.first, ends.second, face, face_of.at({ends.second, ends.first})});
    }
  }
  return as_shape(std::move(made));
}

// A hull without volume, or a solid one that came without faces.
inline Shape bare_hull(std::vector<Vec3d> vertices, int dimension) {
  auto made = std::make_shared<Hull>();
  made->vertices = std::move(vertices);
  made->dimension = dimension;
  made->neighbours.resize(made->vertices.size());
  return as_shape(std::move(made));
}

inline Shape box_as_hull(double x, double y, double z) {
  std::vector<Vec3d> v;
  for (int k = 0; k < 8; ++k) {
    v.emplace_back((k & 1) != 0 ? x : -x, (k & 2) != 0 ? y : -y, (k & 4) != 0 ? z : -z);
  }
  return hull(std::move(v),
              {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

inline Shape tetrahedron() {
  return hull({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
              {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

// The hull of points in general position, all of them extreme or inside: every triple is tried.
inline Shape hull_of(const std::vector<Vec3d>& points) {
  std::vector<std::vector<std::uint32_t>> loops;
  const auto n = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t k = 0; k < n; ++k) {
        if (j <= i || k <= i || j == k) continue;
        const Vec3d normal = (points[j] - points[i]).cross(points[k] - points[i]);
        bool face = true;
        for (std::uint32_t l = 0; l < n && face; ++l) {
          face = l == i || l == j || l == k || normal.dot(points[l] - points[i]) < 0;
        }
        if (face) loops.push_back({i, j, k});
      }
    }
  }
  return hull(points, loops);
}

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline Vec3d random_direction(Random& random) {
  std::normal_distribution<double> normal;
  const double z = normal(random), y = normal(random), x = normal(random);
  return Vec3d(x, y, z).normalized();
}
// A vector of a length from `low` to `high`.
inline Vec3d random_vector(Random& random, double low, double high) {
  const Vec3d direction = random_direction(random);
  return uniform(random, low, high) * direction;
}
inline Mat3d random_rotation(Random& random) {
  std::normal_distribution<double> normal;
  const double z = normal(random), y = normal(random), x = normal(random), w = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}
inline Shape random_hull(Random& random, int points) {
  std::vector<Vec3d> on_sphere;
  for (int k = 0; k < points; ++k) on_sphere.push_back(random_direction(random));
  return hull_of(on_sphere);
}

inline Shape any_hull(Random& random) {
  return random_hull(random, 4 + static_cast<int>(random() % 20));
}

inline Shape octahedron() {
  return hull_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
}
inline Shape icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3d> v;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-g, g}) {
      v.emplace_back(0, s, t);
      v.emplace_back(s, t, 0);
      v.emplace_back(t, 0, s);
    }
  }
  return hull_of(v);
}

// The point of the body that lies furthest in a direction (world).
inline Vec3d support(const Shape& shape, const Pose& pose, const Vec3d& direction) {
  const Vec3d d = pose.rotation.transpose() * direction;
  const double disc = std::hypot(d.x(), d.y());
  const Vec3d rim =
      disc > 0 ? Vec3d(shape.radius * d.x() / disc, shape.radius * d.y() / disc, 0) : Vec3d::Zero();
  const Vec3d end(0, 0, std::copysign(shape.half_length, d.z()));
  Vec3d point = Vec3d::Zero();
  switch (shape.kind) {
    case ShapeKind::sphere: point = shape.radius * d.normalized(); break;
    case ShapeKind::capsule: point = end + shape.radius * d.normalized(); break;
    case ShapeKind::box:
      for (int k = 0; k < 3; ++k) point[k] = std::copysign(shape.half_extents[k], d[k]);
      break;
    case ShapeKind::cylinder: point = end + rim; break;
    case ShapeKind::cone: {
      const Vec3d tip(0, 0, shape.half_length), base = rim - tip;
      point = tip.dot(d) > base.dot(d) ? tip : base;
      break;
    }
    case ShapeKind::ellipsoid: {
      const Vec3d stretched = shape.radii.cwiseProduct(d);
      point = shape.radii.cwiseProduct(stretched.normalized());
      break;
    }
    case ShapeKind::hull:
      point = shape.hull->vertices[0];
      for (const Vec3d& v : shape.hull->vertices) {
        if (v.dot(d) > point.dot(d)) point = v;
      }
      break;
    case ShapeKind::halfspace: point = shape.normal * (shape.offset / shape.normal.squaredNorm());
  }
  return pose(point);
}

inline NarrowPhaseSettings settings_of(Precision scalar) {
  NarrowPhaseSettings settings;
  settings.scalar = scalar;
  return settings;
}

enum class Call : std::uint8_t { batch, alone };

// The algorithm's answer for one pair in the given order. If the kinds are in the other order than
// in a batch, the pair is swapped, and the outcome swapped back.
inline Outcome ask(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings, Task task,
                   const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                   Call call = Call::batch) {
  const bool swap = a.kind > b.kind;
  const std::vector<Shape> shapes = swap ? std::vector{b, a} : std::vector{a, b};
  const std::vector<Pose> poses = swap ? std::vector{pose_b, pose_a} : std::vector{pose_a, pose_b};
  const std::array<std::uint32_t, 2> shape_of{0, 1};
  const std::array<std::uint32_t, 1> first{0}, second{1};
  std::array<Outcome, 1> outcomes;
  const auto algorithm = entry.make(settings);
  algorithm->bind(shapes);
  const PairBatch batch{
      .kind_a = shapes[0].kind,
      .kind_b = shapes[1].kind,
      .pairs = {.first = first, .second = second, .shape_of = shape_of, .poses = poses}};
  if (call == Call::alone) {
    algorithm->solve_alone(task, batch, 0, outcomes[0]);
  } else {
    algorithm->solve(task, batch, outcomes);
  }
  Outcome outcome = outcomes[0];
  if (swap) {
    outcome.normal = -outcome.normal;
    std::swap(outcome.witness_a, outcome.witness_b);
  }
  return outcome;
}

}  // namespace touchstone::test
