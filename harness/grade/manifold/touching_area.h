// The area in which the faces of two flat-sided bodies touch.
#pragma once

#include <optional>
#include <vector>

#include "algorithms/contact_manifold.h"
#include "harness/files/cases.h"

namespace touchstone::grade {

using Real = long double;

struct AreaPoint {
  Real x = 0, y = 0;  // coordinates across the normal, metres
  Real depth = 0;     // depth along the normal, metres
};

// A coordinate frame across a normal, with body a's place as its origin.
struct AreaFrame {
  Vec3<Real> u, v, normal, origin;
  AreaPoint see(const Vec3<Real>& world) const;
};

AreaFrame area_frame(const files::Case& c, const Vec3d& normal);

// Returns the corners of the contact area: the overlap, seen along the normal, of the face of a
// that lies furthest along the normal and the face of b that lies furthest against it, limited to
// where the faces interpenetrate. It intersects every two lines of the outlines and of the faces'
// intersection, and keeps the corners that no line cuts off. The result is empty if there is no
// area or a face is more than 20 degrees off, and nullopt if a body has no faces.
std::optional<std::vector<AreaPoint>> touching_area(const files::Case& c, const AreaFrame& frame);

// Returns the area of the points' convex hull.
Real hull_area(std::vector<AreaPoint> points);
// Returns the greatest area of four (or fewer) of the points that include one as deep as the
// deepest, within the slack.
Real greatest_area_of_four(const std::vector<AreaPoint>& points, Real slack);

}  // namespace touchstone::grade
