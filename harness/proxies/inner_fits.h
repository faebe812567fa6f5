// Collision proxies inside a convex body: ball, boxes, k-DOP, capsule and hulls.
#pragma once

#include "harness/proxies/certainty.h"

namespace touchstone::proxies {

// All are in the body's local frame and certainly inside the body. The body must be convex (no
// mesh) and have an interior; otherwise they throw InputError. A "copy" is the greatest scaled copy
// of the outer proxy (greatest_copy.h; to a thousandth for a round shape), shrunk until every
// corner's clearance is certain.

// The greatest ball around the deepest point, up to rounding.
Part inner_sphere(const LocalBody& body);
// Copies of the outer box, oriented box and k-DOP.
Part inner_box(const LocalBody& body);
Part inner_oriented_box(const LocalBody& body);
Part inner_dop(const LocalBody& body, int directions);
// The greatest volume over the oriented box's axes and the ratios of length to radius.
Part inner_capsule(const LocalBody& body);
// The hull of at most `vertices` (at least 8) of the body's vertices, each the farthest from the
// hull of those before it.
Part inner_reduced_hull(const LocalBody& body, int vertices);
// A polytope with vertices on the round shape's surface, moved inward by rounding
// (geometry/tessellation.h).
Part inner_icosphere(const LocalBody& body, int level);

}  // namespace touchstone::proxies
