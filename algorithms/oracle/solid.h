// Part of the oracle, used by harness/grade too: the bodies of the exact problem.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::oracle {

// A shape prepared once: a core and a ball around it.
struct Solid {
  enum class Core : std::uint8_t { polytope, cylinder, cone, ellipsoid, halfspace };

  // The shape's numbers must be finite, and a hull must be set if the kind is hull. The solid keeps
  // no reference to the shape.
  explicit Solid(const Shape& shape);

  Core core = Core::polytope;
  double radius = 0;  // metres; no matrix deforms the ball

  // Polytope: the core is the convex hull of these, in body coordinates. Sphere: the centre.
  // Capsule: the lower end of the segment, then the upper one. Box: vertex i has +half_extents[k]
  // if bit k of i is set, otherwise -half_extents[k]. Hull: its vertices. A cylinder, cone or
  // ellipsoid that is a point or a segment is a polytope of its two ends, (0, 0, -half_length) and
  // (0, 0, +half_length), or -radii and +radii.
  std::vector<Vec3d> vertices;

  // Cylinder, cone: radius, radius, half length; ellipsoid: semi-axes. At least two are > 0.
  Vec3d extents = Vec3d::Zero();

  Vec3d normal = Vec3d::UnitZ();  // half-space: normal . x <= offset, in body coordinates
  double offset = 0;

  bool is_curved() const { return core > Core::polytope && core < Core::halfspace; }

  // The members below are derived from those above.
  bool is_box = false;  // the vertices are those of a box, numbered as above
  // Coordinate k of every vertex, and of every point made on a curved core, is an integer times
  // 2^grid[k].
  std::array<int, 3> grid{};
  // No coordinate is greater than 2^exponent in magnitude. x, y, z are the vertices divided by
  // that, for filters.
  int exponent = 0;
  std::vector<double> x, y, z;
};

// The set {M v + t : v in the core} + Ball(radius). M is `matrix` with every stored number taken
// literally. With a quaternion (w, x, y, z; nonzero) it is R(q) / |q|^2 instead, which is exactly
// orthonormal.
struct Body {
  const Solid* solid = nullptr;
  Mat3d matrix = Mat3d::Identity();
  Vec3d translation = Vec3d::Zero();  // metres
  std::optional<std::array<double, 4>> quaternion = {};
  // With it the body is all that it covers while it moves by [0] - [1] (metres), a difference that is not
  // rounded. No certificate has such a body.
  std::optional<std::array<Vec3d, 2>> sweep = {};

  Body(const Solid& s, const Pose& pose)
      : solid(&s), matrix(pose.rotation), translation(pose.translation) {}
  Body(const Solid& s, const std::array<double, 4>& q, const Vec3d& t)
      : solid(&s), translation(t), quaternion(q) {}

  // True if all numbers of the matrix and the translation are. Others are no body.
  bool is_finite() const { return matrix.allFinite() && translation.allFinite(); }
};

}  // namespace touchstone::oracle
