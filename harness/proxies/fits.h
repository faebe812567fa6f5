// Collision proxies around a convex body, inside it, and inside the solid of a closed mesh: ball,
// boxes, k-DOP, capsule and hulls.
#pragma once

#include <optional>
#include <vector>

#include "harness/geometry/mesh_solid.h"
#include "harness/proxies/local_body.h"

namespace touchstone::proxies {

// All are in the body's local frame and certainly contain every point of the body (of its hull, for
// a mesh): radii and extents are rounded up beyond a bound on their error, and hulls are proven
// (local_body.h). A flat body's hulls get a thickness of about 3e-8 of its size.

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

// All are in the body's local frame and certainly inside the body. The body must be convex (no
// mesh) and have an interior; otherwise they throw InputError. A "copy" is the greatest scaled copy
// of the outer proxy (optimal_fits.h; to a thousandth for a round shape), shrunk until every
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

// Works in the body's local frame. Throws InputError if a piece of the mesh is not closed, or if no
// ball inside is found. A proxy is inside if it touches no triangle and contains a point around
// which the surface winds. Distances to triangles are those to planes in between, minus their
// rounding. For polytopes, the exact oracle tests every triangle that no face's plane separates.
class MeshInside {
 public:
  explicit MeshInside(const LocalBody& body);

  // The greatest ball found by ascent from the eight deepest of 2,048 points.
  Part sphere() const;
  // The greatest copy of this convex part (a box or a hull) around the ball's centre.
  Part copy(const Part& part) const;
  // The longest capsule of five radii along the three axes, through the ball's centre.
  Part capsule(const Mat3d& axes) const;
  // The greatest copy of each part around the point that is deepest in it and in the body. Parts
  // for which none is found are left out.
  std::vector<Part> copies(const std::vector<Part>& parts) const;

 private:
  bool winds_about(const Vec3d& x) const;
  double clearance(const Vec3d& x) const;
  // Samples `count` points in the box, ascends from the best, and returns the inside point with the
  // greatest measure, if that is > 0.
  template <class Measure>
  std::optional<Vec3d> deepest(const Vec3d& low, const Vec3d& high, int count,
                               const Measure& measure) const;
  std::optional<Part> copy_about(const Part& part, const Vec3d& centre) const;

  const LocalBody& body_;
  geometry::Surface surface_{{}};
  Vec3d centre_ = Vec3d::Zero();
};

}  // namespace touchstone::proxies
