// Bodies of the exact problem.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::oracle {

// A shape made ready, once: a core and a ball around it.
struct Solid {
  enum class Core : std::uint8_t { polytope, cylinder, cone, ellipsoid, halfspace };

  // The shape's numbers are finite, and a hull is there where it is needed. The solid keeps no
  // reference to it.
  explicit Solid(const Shape& shape);

  Core core = Core::polytope;
  double radius = 0;  // metres: of the ball, which no matrix deforms

  // Polytope: the core is the convex hull of these, in body coordinates. Sphere: the centre.
  // Capsule: the lower end of the segment, then the upper one. Box: vertex i has +half_extents[k]
  // where bit k of i is set, -half_extents[k] otherwise. Hull: its vertices. Cylinder, cone and
  // ellipsoid that are a point or a segment are polytopes too: of both ends, (0, 0, -half_length)
  // and (0, 0, +half_length), or -radii and +radii.
  std::vector<Vec3d> vertices;

  // Cylinder, cone: radius, radius, half length; ellipsoid: semi-axes. At least two are > 0.
  Vec3d extents = Vec3d::Zero();

  Vec3d normal = Vec3d::UnitZ();  // half-space: normal . x <= offset, in body coordinates
  double offset = 0;

  bool is_curved() const { return core > Core::polytope && core < Core::halfspace; }

  // Made from the above.
  bool is_box = false;  // the vertices are those of a box, numbered as above
  // Coordinate k of every vertex, and of every point of a curved core that is used, is an integer
  // times 2^grid[k].
  std::array<int, 3> grid{};
  // No coordinate is greater than 2^exponent in magnitude; the vertices over that, for filters.
  int exponent = 0;
  std::vector<double> x, y, z;
};

// {M v + t : v in the core} + Ball(radius). M is `matrix` as it stands, every stored number
// literal; with a quaternion (w, x, y, z; not zero) it is R(q) / |q|^2 instead, which is exactly
// orthonormal.
struct Body {
  const Solid* solid = nullptr;
  Mat3d matrix = Mat3d::Identity();
  Vec3d translation = Vec3d::Zero();  // metres
  std::optional<std::array<double, 4>> quaternion = {};

  Body(const Solid& s, const Pose& pose)
      : solid(&s), matrix(pose.rotation), translation(pose.translation) {}
  Body(const Solid& s, const std::array<double, 4>& q, const Vec3d& t)
      : solid(&s), translation(t), quaternion(q) {}
};

}  // namespace touchstone::oracle
