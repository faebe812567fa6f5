// What is inside the solid of a closed mesh, convex or not.
#pragma once

#include <optional>
#include <vector>

#include "harness/geometry/mesh_solid.h"
#include "harness/proxies/local_body.h"

namespace touchstone {

// In the body's local frame. Throws InputError where a piece of the mesh is not closed, or no ball
// inside was found. What is inside touches no triangle, and has a point that the surface winds
// about: distances to triangles are those to planes between, less their rounding; polytopes are
// held against every triangle that no face's plane keeps away by the exact oracle.
class MeshInside {
 public:
  explicit MeshInside(const LocalBody& body);

  // The greatest ball that was found: from the eight deepest of 2,048 points, climbed.
  Part sphere() const;
  // The greatest copy of this convex part (a box or a hull) about the ball's centre.
  Part copy(const Part& part) const;
  // The longest of five radii along the three axes, through the ball's centre.
  Part capsule(const Mat3d& axes) const;
  // Of each part the greatest copy about the point deepest in it and in the body; those in which
  // none was found are left out.
  std::vector<Part> copies(const std::vector<Part>& parts) const;

 private:
  bool winds_about(const Vec3d& x) const;
  double clearance(const Vec3d& x) const;
  // The point inside, of `count` in the box and then climbed, where this is greatest, if it is > 0.
  template <class Measure>
  std::optional<Vec3d> deepest(const Vec3d& low, const Vec3d& high, int count,
                               const Measure& measure) const;
  std::optional<Part> copy_about(const Part& part, const Vec3d& centre) const;

  const LocalBody& body_;
  std::vector<std::vector<Triangle>> pieces_;
  Surface surface_{{}};
  Vec3d centre_ = Vec3d::Zero();
};

}  // namespace touchstone
