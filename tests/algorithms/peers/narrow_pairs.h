// Pairs of bodies whose distance and depth are known by construction, for the peers' narrow phases.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::narrow_pairs {

struct Placed {
  Shape shape;
  Pose pose;
};

inline Placed placed(Shape shape, const Vec3d& at = Vec3d::Zero()) {
  return {std::move(shape), {Mat3d::Identity(), at}};
}

struct Ask {
  Precision scalar = Precision::float64;
  std::optional<double> tolerance = {};
  std::optional<int> max_iterations = {};

  NarrowPhaseSettings settings() const { return {scalar, tolerance, max_iterations}; }
};

// A point of a shape's boundary, in body coordinates, at which `normal` (unit length) is an outward
// normal: the body lies behind the plane through it. `deep`: a push along the normal is the
// shortest way out of a shallow overlap, whatever the other body; it is not at a vertex or rim.
struct Feature {
  Vec3d point, normal;
  bool deep;
};

inline Mat3d random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  const double z = gauss(random), y = gauss(random), x = gauss(random), w = gauss(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

inline Vec3d random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> gauss;
  const double z = gauss(random), y = gauss(random), x = gauss(random);
  return Vec3d(x, y, z).normalized();
}

// Edges and neighbours from vertices and faces.
inline std::shared_ptr<const Hull> complete(Hull hull) {
  hull.neighbours.resize(hull.vertices.size());
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const auto& loop = hull.faces[f].loop;
    const Vec3d& a = hull.vertices[loop[0]];
    hull.faces[f].normal =
        (hull.vertices[loop[1]] - a).cross(hull.vertices[loop[2]] - a).normalized();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t tail = loop[i], head = loop[(i + 1) % loop.size()];
      hull.neighbours[tail].push_back(head);
      for (std::uint32_t g = 0; tail < head && g < hull.faces.size(); ++g) {
        const auto& other = hull.faces[g].loop;
        for (std::size_t j = 0; j < other.size(); ++j) {
          if (other[j] == head && other[(j + 1) % other.size()] == tail) {
            hull.edges.push_back({tail, head, f, g});
          }
        }
      }
    }
  }
  return std::make_shared<const Hull>(std::move(hull));
}

// The origin is inside, and is no vertex's mean.
inline std::shared_ptr<const Hull> tetrahedron() {
  Hull hull;
  hull.vertices = {{1, 0, -0.3}, {-0.5, 0.8, -0.3}, {-0.6, -0.7, -0.3}, {0.1, 0, 0.9}};
  for (std::vector<std::uint32_t> loop :
       {std::vector<std::uint32_t>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    hull.faces.push_back({std::move(loop), Vec3d::Zero()});
  }
  return complete(std::move(hull));
}

// A prism over a regular polygon: more than 32 vertices make FCL climb along edges.
inline std::shared_ptr<const Hull> prism(std::uint32_t sides, double radius, double half_length) {
  Hull hull;
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    hull.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -half_length);
    hull.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), half_length);
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
    const std::uint32_t next = (i + 1) % sides;
    hull.faces.push_back({{2 * i, 2 * next, 2 * next + 1, 2 * i + 1}, Vec3d::Zero()});
  }
  hull.faces.push_back({bottom, Vec3d::Zero()});
  hull.faces.push_back({top, Vec3d::Zero()});
  return complete(std::move(hull));
}

inline Shape sphere(double radius) {
  Shape shape;
  shape.radius = radius;
  return shape;
}
// A capsule, cylinder or cone.
inline Shape along_z(ShapeKind kind, double radius, double half_length) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
inline Shape box(const Vec3d& half_extents) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = half_extents;
  return shape;
}
inline Shape ellipsoid(const Vec3d& radii) {
  Shape shape;
  shape.kind = ShapeKind::ellipsoid;
  shape.radii = radii;
  return shape;
}
inline Shape halfspace(const Vec3d& normal, double offset) {
  Shape shape;
  shape.kind = ShapeKind::halfspace;
  shape.normal = normal;
  shape.offset = offset;
  return shape;
}
inline Shape hull_shape(std::shared_ptr<const Hull> hull) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return shape;
}
inline Shape flat_hull(std::vector<Vec3d> points, int dimension) {
  Hull hull;
  hull.neighbours.resize(points.size());
  hull.vertices = std::move(points);
  hull.dimension = dimension;
  return hull_shape(std::make_shared<const Hull>(std::move(hull)));
}

// Two shapes of each kind, of unlike proportions; one for half-spaces, with a normal of length 2.
inline std::vector<Shape> shapes_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere: return {sphere(0.7), sphere(1.6)};
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: return {along_z(kind, 0.5, 1.1), along_z(kind, 1.2, 0.6)};
    case ShapeKind::box: return {box({0.5, 0.8, 1.3}), box({1, 1, 1})};
    case ShapeKind::ellipsoid: return {ellipsoid({0.5, 0.9, 1.4}), ellipsoid({1.2, 1.1, 0.8})};
    case ShapeKind::hull: return {hull_shape(tetrahedron()), hull_shape(prism(20, 0.9, 0.7))};
    case ShapeKind::halfspace: return {halfspace({0, 1.2, 1.6}, 0.8)};
  }
  return {};
}

inline std::vector<Feature> features_of(const Shape& shape) {
  const double r = shape.radius, h = shape.half_length, diagonal = std::sqrt(0.5);
  const Vec3d x = Vec3d::UnitX(), z = Vec3d::UnitZ();
  switch (shape.kind) {
    case ShapeKind::sphere: {
      const Vec3d n(0.48, -0.6, 0.64);
      return {{r * n, n, true}};
    }
    case ShapeKind::capsule: {
      const Vec3d n(0.6, 0, -0.8);
      return {{r * x, x, true}, {-h * z + r * n, n, true}};
    }
    case ShapeKind::box: {
      const Vec3d& e = shape.half_extents;
      return {{{e.x(), 0.1 * e.y(), -0.2 * e.z()}, x, true},
              {{e.x(), -e.y(), e.z()}, Vec3d(1, -1, 1).normalized(), false}};
    }
    case ShapeKind::cylinder:
      return {{{0.1 * r, 0.2 * r, -h}, -z, true},
              {{r, 0, 0.1 * h}, x, true},
              {{r, 0, h}, diagonal * (x + z), false}};
    case ShapeKind::cone:
      return {{{0.1 * r, 0.2 * r, -h}, -z, true},
              {{0, 0, h}, z, false},
              {{r, 0, -h}, diagonal * (x - z), false}};
    case ShapeKind::ellipsoid: return {{shape.radii.x() * x, x, true}};
    case ShapeKind::hull: {
      const Hull::Face& face = shape.hull->faces[1];
      Vec3d middle = Vec3d::Zero(), mean = Vec3d::Zero();
      for (const std::uint32_t i : face.loop) middle += shape.hull->vertices[i];
      for (const Vec3d& vertex : shape.hull->vertices) mean += vertex;
      middle /= static_cast<double>(face.loop.size());
      mean /= static_cast<double>(shape.hull->vertices.size());
      // The vertex that is farthest from the mean, seen from there.
      Vec3d tip = mean;
      for (const Vec3d& vertex : shape.hull->vertices) {
        if ((vertex - mean).norm() > (tip - mean).norm() + 1e-9) tip = vertex;
      }
      return {{middle, face.normal, true}, {tip, (tip - mean).normalized(), false}};
    }
    case ShapeKind::halfspace: {
      const Vec3d n = shape.normal.normalized();
      return {{n * (shape.offset / shape.normal.norm()) + 0.3 * x, n, true}};
    }
  }
  return {};
}

// Puts b so that the two features face each other, `gap` apart along a random world direction,
// which is returned: from a to b. The gap is the distance. Below zero its opposite is the depth,
// where one of the features is `deep`, the overlap is shallow and the bodies are not thin.
inline Vec3d face(Placed& a, const Feature& on_a, Placed& b, const Feature& on_b, double gap,
                  std::mt19937_64& random) {
  a.pose.rotation = random_rotation(random);
  a.pose.translation = 0.7 * random_unit(random);
  const Vec3d direction = a.pose.rotation * on_a.normal;
  const Mat3d spin =
      Eigen::AngleAxisd(std::uniform_real_distribution<double>(0, 6.28)(random), direction)
          .toRotationMatrix();
  b.pose.rotation = spin * base::rotation_between(on_b.normal, -direction);
  b.pose.translation = a.pose(on_a.point) + gap * direction - b.pose.rotation * on_b.point;
  return direction;
}

// How far the world point is outside of the body, at least; <= 0 inside. Zero sizes are not for
// this.
inline double outside(const Placed& body, const Vec3d& world) {
  const Shape& s = body.shape;
  const Vec3d p = body.pose.rotation.transpose() * (world - body.pose.translation);
  const double radial = p.head<2>().norm();
  switch (s.kind) {
    case ShapeKind::sphere: return p.norm() - s.radius;
    case ShapeKind::capsule: {
      const Vec3d axis(0, 0, std::clamp(p.z(), -s.half_length, s.half_length));
      return (p - axis).norm() - s.radius;
    }
    case ShapeKind::box: return (p.cwiseAbs() - s.half_extents).maxCoeff();
    case ShapeKind::cylinder: return std::max(radial - s.radius, std::abs(p.z()) - s.half_length);
    case ShapeKind::cone: {
      const double slant = std::hypot(s.radius, 2 * s.half_length);
      const double side = (2 * s.half_length * radial + s.radius * (p.z() - s.half_length)) / slant;
      return std::max(side, -s.half_length - p.z());
    }
    case ShapeKind::ellipsoid: return (p.cwiseQuotient(s.radii).norm() - 1) * s.radii.minCoeff();
    case ShapeKind::hull: {
      double most = -1e300;
      for (const Hull::Face& f : s.hull->faces) {
        most = std::max(most, f.normal.dot(p - s.hull->vertices[f.loop[0]]));
      }
      return most;
    }
    case ShapeKind::halfspace: return (s.normal.dot(p) - s.offset) / s.normal.norm();
  }
  return 0;
}

// Asks for one pair, in the order of kinds that the contract wants, and turns the answer back.
inline Outcome ask(const NarrowPhaseEntry& entry, Task task, const Placed& a, const Placed& b,
                   const Ask& how = {}) {
  if (a.shape.kind > b.shape.kind) {
    Outcome outcome = ask(entry, task, b, a, how);
    outcome.normal = -outcome.normal;
    std::swap(outcome.witness_a, outcome.witness_b);
    return outcome;
  }
  const std::array<Shape, 2> shapes = {a.shape, b.shape};
  const std::array<Pose, 2> poses = {a.pose, b.pose};
  const std::array<std::uint32_t, 2> ids = {0, 1};
  const std::span<const std::uint32_t> all(ids);
  const std::unique_ptr<NarrowPhase> algorithm = entry.make(how.settings());
  algorithm->bind(shapes);
  Outcome outcome;
  algorithm->solve(
      task,
      {.kind_a = a.shape.kind,
       .kind_b = b.shape.kind,
       .pairs = {.first = all.first(1), .second = all.last(1), .shape_of = all, .poses = poses}},
      {&outcome, 1});
  return outcome;
}

// A pair as `face` has placed it.
struct KnownPair {
  Placed a, b;
  double gap;
  Vec3d direction;
  bool deep;  // gap < 0: whether its opposite is the depth
};

// What a failure says of a pair.
inline std::string kinds_of(const KnownPair& pair) {
  return std::string(to_string(pair.a.shape.kind)) + ", " +
         std::string(to_string(pair.b.shape.kind)) + ", gap " + std::to_string(pair.gap);
}

// Every pair of kinds that the algorithm takes for the task, shapes and features, at each gap, in
// `rounds` random poses.
template <class Visit>
void for_known_pairs(const NarrowPhaseEntry& entry, Task task, std::span<const double> gaps,
                     int rounds, Visit visit) {
  std::mt19937_64 random(20);
  for (const ShapeKind kind_a : all_shape_kinds) {
    for (const ShapeKind kind_b : all_shape_kinds) {
      if (kind_b < kind_a || !offers(entry, kind_a, kind_b, task)) continue;
      for (const Shape& shape_a : shapes_of(kind_a)) {
        for (const Shape& shape_b : shapes_of(kind_b)) {
          for (const Feature& on_a : features_of(shape_a)) {
            for (const Feature& on_b : features_of(shape_b)) {
              for (int i = 0; i < rounds * static_cast<int>(gaps.size()); ++i) {
                KnownPair pair{{shape_a, {}}, {shape_b, {}}, gaps[i % gaps.size()], {}, false};
                pair.direction = face(pair.a, on_a, pair.b, on_b, pair.gap, random);
                pair.deep = on_a.deep || on_b.deep;
                visit(pair);
              }
            }
          }
        }
      }
    }
  }
}

struct Agreement {
  int separated = 0, overlapping = 0, disagree = 0;
};

// Asks both whether random pairs intersect, leaving out those whose answer, by the first, changes
// when b is moved by 1e-3 along the line of the origins.
inline Agreement agreement(const NarrowPhaseEntry& one, const NarrowPhaseEntry& other, int rounds,
                           const Ask& how) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> spread(0.5, 3.5);
  Agreement count;
  for (const ShapeKind kind_a : all_shape_kinds) {
    for (const ShapeKind kind_b : all_shape_kinds) {
      if (kind_b < kind_a || kind_b == ShapeKind::halfspace) continue;
      if (!offers(one, kind_a, kind_b, Task::intersect)) continue;
      if (!offers(other, kind_a, kind_b, Task::intersect)) continue;
      for (int i = 0; i < rounds; ++i) {
        const std::vector<Shape> of_a = shapes_of(kind_a), of_b = shapes_of(kind_b);
        const Placed a{of_a[i % of_a.size()], {random_rotation(random), Vec3d::Zero()}};
        const Vec3d apart = random_unit(random);
        const double distance = spread(random);
        const auto at = [&, turn = random_rotation(random)](double d) {
          return Placed{of_b[(i / 2) % of_b.size()], {turn, d * apart}};
        };
        const auto answer = [&](const NarrowPhaseEntry& entry, double d) {
          return ask(entry, Task::intersect, a, at(d), how).answer;
        };
        const Answer first = answer(one, distance);
        if (first != answer(one, distance - 1e-3) || first != answer(one, distance + 1e-3))
          continue;
        ++(first == Answer::separated ? count.separated : count.overlapping);
        if (first != answer(other, distance)) ++count.disagree;
      }
    }
  }
  return count;
}

}  // namespace touchstone::narrow_pairs
