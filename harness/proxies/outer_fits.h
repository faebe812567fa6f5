// What holds a body: ball, boxes, k-DOP, capsule and a hull of few vertices around it.
#pragma once

#include <vector>

#include "harness/proxies/local_body.h"

namespace touchstone {

// Each in the body's local frame, and each certainly holds every point of the body (of its hull,
// for a mesh): radii and extents are rounded up beyond a bound on their error, hulls are proven
// (certainty.h). A flat body's hulls are given a thickness of about 3e-8 of its size.

// The least ball, to rounding.
Part outer_sphere(const LocalBody& body);
// The least box along the own axes, to rounding.
Part outer_box(const LocalBody& body);
// Of the least volume found: a hull's over its 64 greatest faces with the edges of its outline,
// then turned in steps down to 1e-4 rad while that helps; a round shape's least one is along its
// axes.
Part outer_oriented_box(const LocalBody& body);
// Of the least volume found, about the axes of the oriented box turned in steps down to 0.01 rad.
Part outer_capsule(const LocalBody& body);
// `directions` is 14, 18 or 26: axes and corners, axes and edges, all.
Part outer_dop(const LocalBody& body, int directions);
// At most `vertices` of them, at least 8: the better of two, the oriented box cut by the body's
// planes where a corner is farthest beyond one, and the inner hull scaled up.
Part outer_reduced_hull(const LocalBody& body, int vertices);
// Of all points of a mesh.
Part outer_hull(const LocalBody& body);
// Of level 0 to 5 (scene/polytope.h), its faces touching the round shape's surface.
Part outer_icosphere(const LocalBody& body, int level);

// Vertices of the body, as far from each other's hull as they come: at most `count`, at least 4.
std::vector<Vec3d> farthest_vertices(const std::vector<Vec3d>& vertices, int count);
// Half the sum of directions of a k-DOP: one of each opposite pair.
std::vector<Vec3d> dop_normals(int directions);
// The longest, middle and shortest axis of the oriented box, right-handed.
Mat3d fitting_axes(const LocalBody& body);

}  // namespace touchstone
