// The area in which the faces of two flat-sided bodies touch.
#pragma once

#include <optional>
#include <vector>

#include "algorithms/contact_manifold.h"
#include "harness/files/cases.h"

namespace touchstone::grade {

using Real = long double;

struct AreaPoint {
  Real x = 0, y = 0;  // across the normal, metres
  Real depth = 0;     // metres, along it
};

// A frame across a normal, about body a's place.
struct AreaFrame {
  Vec3<Real> u, v, normal, origin;
  AreaPoint see(const Vec3<Real>& world) const;
};

AreaFrame area_frame(const files::Case& c, const Vec3d& normal);

// The corners of the polygon in which the face of a that lies furthest along the normal and that of
// b that lies furthest against it overlap, seen along the normal, where one is below the other.
// Every two lines of the outlines, and of the faces' intersection, are brought to an intersection;
// the corners are those that no line cuts off. Empty where there is no area or a face is more than
// 20 degrees off, nullopt where a body has no faces.
std::optional<std::vector<AreaPoint>> touching_area(const files::Case& c, const AreaFrame& frame);

// Of the convex hull of the points.
Real hull_area(std::vector<AreaPoint> points);
// The greatest of four (or less) of the points one of which is as deep as the deepest, within the
// slack.
Real greatest_area_of_four(const std::vector<AreaPoint>& points, Real slack);

}  // namespace touchstone::grade
