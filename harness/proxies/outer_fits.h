// Collision proxies around a body: ball, boxes, k-DOP, capsule and a hull of few vertices.
#pragma once

#include <vector>

#include "harness/proxies/local_body.h"

namespace touchstone::proxies {

// All are in the body's local frame and certainly contain every point of the body (of its hull, for
// a mesh): radii and extents are rounded up beyond a bound on their error, and hulls are proven
// (certainty.h). A flat body's hulls get a thickness of about 3e-8 of its size.

// The least ball, up to rounding.
Part outer_sphere(const LocalBody& body);
// The least box along the body's axes, up to rounding.
Part outer_box(const LocalBody& body);
// The least volume found. For a hull the search covers its 64 largest faces with the edges of the
// outline, then rotations in steps down to 1e-4 rad while they help. For a round shape it is along
// its axes.
Part outer_oriented_box(const LocalBody& body);
// The least volume found, from the axes of the oriented box rotated in steps down to 0.01 rad.
Part outer_capsule(const LocalBody& body);
// `directions` is 14, 18 or 26: axes and corners, axes and edges, all.
Part outer_dop(const LocalBody& body, int directions);
// A hull of at most `vertices` (at least 8) vertices: the better of the oriented box cut by the
// body's planes where a corner is farthest beyond one, and the inner hull scaled up.
Part outer_reduced_hull(const LocalBody& body, int vertices);
// The hull of all points of a mesh.
Part outer_hull(const LocalBody& body);
// A polytope of level 0 to 5 (geometry/tessellation.h) whose faces touch the round shape's surface.
Part outer_icosphere(const LocalBody& body, int level);

// Returns at most `count` (at least 4) vertices of the body, each as far as possible from the hull
// of those before it.
std::vector<Vec3d> farthest_vertices(const std::vector<Vec3d>& vertices, int count);
// Half the directions of a k-DOP: one of each opposite pair.
std::vector<Vec3d> dop_normals(int directions);
// The longest, middle and shortest axis of the oriented box, right-handed.
Mat3d fitting_axes(const LocalBody& body);

}  // namespace touchstone::proxies
