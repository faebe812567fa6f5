// Convex polyhedra as lists of polygons, clipped by planes, and cuts of closed meshes. Used by
// harness/proxies.
#pragma once

#include <span>
#include <vector>

#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"

namespace touchstone::geometry {

// Convex polyhedra as lists of polygons, clipped by planes. Used by harness/proxies.

struct Plane {
  Vec3d normal = Vec3d::UnitX();  // any nonzero length
  double offset = 0;              // inside: normal . x <= offset
};

// Results are correct to rounding; certain claims about them are proven in
// harness/proxies/local_body.h.
class Polyhedron {
 public:
  static Polyhedron box(const Vec3d& low, const Vec3d& high);
  // The hull must be solid and have faces.
  static Polyhedron of(const Hull& hull);

  // Keeps the part on the plane's inner side.
  void clip(const Plane& plane);
  bool empty() const { return faces_.empty(); }
  double volume() const;
  // Each corner once; corners within `tolerance` (metres) are equal.
  std::vector<Vec3d> corners(double tolerance) const;

 private:
  std::vector<std::vector<Vec3d>> faces_;  // anticlockwise from outside
};

// The polyhedron with these planes inside the box.
Polyhedron intersection(const Vec3d& low, const Vec3d& high, std::span<const Plane> planes);

// Triangles of the boundary, anticlockwise from outside. A flat hull gives one side, a segment or a
// point one degenerate triangle.
struct Triangle {
  Vec3d a, b, c;
  Vec3d normal() const { return (b - a).cross(c - a); }  // length: twice the area
};
std::vector<Triangle> triangles_of(const Hull& hull);
double volume_of(std::span<const Triangle> triangles);  // metres cubed, for a closed surface

// Returns the connected pieces on both sides of the plane, or none if the plane does not cut the
// mesh. The plane is moved by a few millionths of the mesh's size if it would touch a vertex.
//
// Each edge that crosses the plane gets one point, shared by both sides. Each side is closed by
// triangles from each loop of its rim to the loop's centre. So the winding numbers of the pieces
// sum to that of the mesh with those points in it, wherever they are rounded to: by less than 8
// units in the last place of the greatest coordinate. Triangles that close a rim which is not
// convex may extend over it, and cancel; volumes are exact.
std::vector<Mesh> cut(const Mesh& mesh, Plane plane);

}  // namespace touchstone::geometry
