// Features of shapes: where, and from which side, another body may touch them.
#pragma once

#include <cstdint>
#include <string_view>

#include "algorithms/core/double_double.h"
#include "algorithms/core/shape.h"
#include "harness/base/random.h"

namespace touchstone::check {

enum class FeatureKind : std::uint8_t {
  vertex,  // of a box or hull
  edge,    // of a box or hull
  face,    // of a box, hull or half-space
  smooth,  // sphere, ellipsoid, cap of a capsule: one point for each normal
  side,    // of a capsule, cylinder or cone: a line for each normal
  rim,     // where the side of a cylinder or cone meets its base
  tip,     // of a cone
  base,    // of a cylinder (either end) or cone
};

std::string_view to_string(FeatureKind kind);
bool has_feature(ShapeKind shape, FeatureKind feature);

// In body coordinates (metres). The shape's points x have normal . x <= normal . surface point,
// with surface point = point + radius * normal.
struct Feature {
  FeatureKind kind = FeatureKind::vertex;
  DoubleDouble3 point;  // in the feature's interior; where there is a ball around it, its centre
  Vec3d normal = Vec3d::UnitZ();    // unit, in the interior of the normals that the feature has
  Vec3d direction = Vec3d::Zero();  // unit, along an edge, the line of a side, a rim's tangent
  double radius = 0;

  bool has_direction() const {
    return kind == FeatureKind::edge || kind == FeatureKind::side || kind == FeatureKind::rim;
  }
  // Whether the surface has no other normal at the point.
  bool has_one_normal() const {
    return kind == FeatureKind::face || kind == FeatureKind::base || kind == FeatureKind::smooth ||
           kind == FeatureKind::side;
  }
};

// One of the shape's features of that kind, with a point and a normal in their interiors, all drawn
// at random. The shape has such features, but where it is degenerate (a flat hull, a sliver whose
// faces are not known) another kind may come. Points on a half-space's plane are within about
// `reach` (metres) of that nearest the local origin.
Feature pick_feature(const Shape& shape, FeatureKind kind, double reach, base::Random& random);

// A kind that the shape has.
FeatureKind random_feature_kind(const Shape& shape, base::Random& random);

// The feature of a box whose normal is n (unit): a coordinate is free where n's is zero.
Feature box_feature(const Vec3d& half_extents, const Vec3d& n, base::Random& random);

}  // namespace touchstone::check
