// What is inside a convex body: ball, boxes, k-DOP, capsule and hulls.
#pragma once

#include "harness/proxies/certainty.h"

namespace touchstone {

// Each in the body's local frame and certainly inside the body, which is convex (no mesh) and has
// an interior, or InputError. What is called a copy is the greatest scaled copy (greatest_copy.h;
// of a round shape, to a thousandth) of the outer fit, shrunk until every corner's clearance is
// certain.

// About the deepest point: the greatest ball there is, to rounding.
Part inner_sphere(const LocalBody& body);
// Copies of the outer box, oriented box, k-DOP.
Part inner_box(const LocalBody& body);
Part inner_oriented_box(const LocalBody& body);
Part inner_dop(const LocalBody& body, int directions);
// Of the greatest volume over the oriented box's axes and ratios of length to radius.
Part inner_capsule(const LocalBody& body);
// Of at most so many, at least 8, of the body's vertices, each the farthest from the hull of those
// before it.
Part inner_reduced_hull(const LocalBody& body, int vertices);
// Vertices on the round shape's surface, drawn in by rounding (scene/polytope.h).
Part inner_icosphere(const LocalBody& body, int level);

}  // namespace touchstone
