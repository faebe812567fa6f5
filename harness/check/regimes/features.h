// Features of shapes: the places and directions in which another body may touch them.
#pragma once

#include <cstdint>
#include <string_view>

#include "algorithms/core/double_double.h"
#include "algorithms/core/shape.h"
#include "harness/base/random.h"

namespace touchstone::check {

enum class FeatureKind : std::uint8_t {
  vertex,  // vertex of a box or hull
  edge,    // edge of a box or hull
  face,    // face of a box, hull or half-space
  smooth,  // sphere, ellipsoid, cap of a capsule: one point for each normal
  side,    // side of a capsule, cylinder or cone: a line for each normal
  rim,     // circle where the side of a cylinder or cone meets its base
  tip,     // tip of a cone
  base,    // base of a cylinder (either end) or cone
};

std::string_view to_string(FeatureKind kind);
bool has_feature(ShapeKind shape, FeatureKind feature);

// A place on a shape's surface, in body coordinates (metres). All points x of the shape satisfy
// normal . x <= normal . surface point, and surface point = point + radius * normal.
struct Feature {
  FeatureKind kind = FeatureKind::vertex;
  DoubleDouble3 point;  // in the feature's interior; the centre of a ball, if there is one
  Vec3d normal = Vec3d::UnitZ();    // unit, in the interior of the feature's normals
  Vec3d direction = Vec3d::Zero();  // unit: along an edge, a line of a side, or a rim's tangent
  double radius = 0;

  bool has_direction() const {
    return kind == FeatureKind::edge || kind == FeatureKind::side || kind == FeatureKind::rim;
  }
  // Returns whether the surface has only one normal at the point.
  bool has_one_normal() const {
    return kind == FeatureKind::face || kind == FeatureKind::base || kind == FeatureKind::smooth ||
           kind == FeatureKind::side;
  }
};

// Picks one of the shape's features of that kind, with a point and a normal in their interiors, all
// at random. The shape must have such features; a degenerate shape (a flat hull, a sliver whose
// faces are not known) may return another kind. Points on a half-space's plane are within about
// `reach` (metres) of the one nearest the local origin.
Feature pick_feature(const Shape& shape, FeatureKind kind, double reach, base::Random& random);

// Picks a kind that the shape has.
FeatureKind random_feature_kind(const Shape& shape, base::Random& random);

// Returns the feature of a box with normal n (unit): a coordinate is free where n's is zero.
Feature box_feature(const Vec3d& half_extents, const Vec3d& n, base::Random& random);

}  // namespace touchstone::check
