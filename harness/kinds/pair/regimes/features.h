// Features of shapes, in which another body may touch them, and bodies placed at these.
#pragma once

#include <cstdint>
#include <string_view>

#include "algorithms/core/double_double.h"
#include "algorithms/core/shape.h"
#include "harness/base/random.h"
#include "harness/files/cases.h"

namespace touchstone::kinds {

// Features of shapes: the places and directions in which another body may touch them.

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

// Places two bodies at a given gap or depth between two of their features.

// Returns the rotation of b that turns b's normal against a's in the world, up to rounding. The
// rest of the turn aligns the two directions (`aligned`), or is random.
Mat3d facing(const Mat3d& rotation_a, const Feature& a, const Feature& b, bool aligned,
             base::Random& random);

// Translates b. The shapes, the rotations and the translation of a must be set, and the features
// must face each other. For gap >= 0 (metres) the features' surface points get the offset gap *
// normal, so that this is the bodies' distance. For gap < 0 the bodies overlap by that much along
// the normal. If that would not be the least depth, as between two vertices, or is more than a
// fiftieth of a body's width, b moves by -gap towards the middle of a instead, by at most nine
// tenths of the way.
//
// The offset is computed to about 1e-30 and rounded once. `fine` leaves that rounding to the
// translation of a, which becomes tiny: the difference of the two is then right far below an ulp.
void place(files::Case& c, const Feature& a, const Feature& b, double gap, bool fine);

// Translates b so that, along a random direction, the bodies are between well inside each other and
// well apart. With a half-space the direction is its normal.
void place_at_random(files::Case& c, base::Random& random);

}  // namespace touchstone::kinds
