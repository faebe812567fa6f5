// Convex polyhedra as lists of polygons, cut by planes.
#pragma once

#include <span>
#include <vector>

#include "algorithms/core/shape.h"

namespace touchstone {

struct Plane {
  Vec3d normal = Vec3d::UnitX();  // any length but 0
  double offset = 0;              // inside: normal . x <= offset
};

// Good to rounding only: what must be certain is proven about what comes out (certainty.h).
class Polyhedron {
 public:
  static Polyhedron box(const Vec3d& low, const Vec3d& high);
  // Of a solid hull with faces.
  static Polyhedron of(const Hull& hull);

  // Leaves what is on the plane's inner side.
  void clip(const Plane& plane);
  bool empty() const { return faces_.empty(); }
  double volume() const;
  // Each corner once, equal to `tolerance` (metres).
  std::vector<Vec3d> corners(double tolerance) const;

 private:
  std::vector<std::vector<Vec3d>> faces_;  // anticlockwise from outside
};

// The polyhedron with these planes that lies in the box.
Polyhedron intersection(const Vec3d& low, const Vec3d& high, std::span<const Plane> planes);

// Triangles of the boundary, anticlockwise from outside; of a flat hull of its one side, of a
// segment or a point a degenerate one.
struct Triangle {
  Vec3d a, b, c;
  Vec3d normal() const { return (b - a).cross(c - a); }  // twice the area long
};
std::vector<Triangle> triangles_of(const Hull& hull);
double volume_of(std::span<const Triangle> triangles);  // metres cubed, of a closed surface

}  // namespace touchstone
