// Collision proxies inside the solid of a closed mesh, convex or not.
#pragma once

#include <optional>
#include <vector>

#include "harness/geometry/mesh_solid.h"
#include "harness/proxies/local_body.h"

namespace touchstone::proxies {

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
