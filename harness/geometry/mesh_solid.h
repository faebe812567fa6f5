// The solid that a mesh represents, its mass properties, and the connected parts of meshes.
#pragma once

#include <vector>

#include "harness/geometry/mesh.h"
#include "harness/geometry/polyhedron.h"

namespace touchstone::geometry {

// The centre of mass (in the mesh's units) of the solid that a closed mesh bounds. If the mesh is
// open or encloses no volume, so that the centre would be outside the mesh's box, it is that of its
// surface; if it has no surface either, it is the vertices' mean.
Vec3d centre_of_mass(const Mesh& mesh);

// The parts whose triangles are connected by shared edges, in the order of their first triangles,
// each with the vertices that it uses. Vertices without triangles are dropped.
std::vector<Mesh> connected_parts(const Mesh& mesh);

// A part is a set of triangles connected by edges. It is closed if every edge is used as often in
// one direction as in the other. In the parts that are not closed as given, vertices at the same
// place are merged. Parts that are still open enclose nothing, so their convex hull is their solid.
// The solid of the mesh is the union of these and of all points around which the closed parts
// together wind: one that winds the other way inside another is the surface of a cavity.
struct MeshPiece {
  Mesh mesh;
  bool closed = false;
};
std::vector<MeshPiece> pieces_of(const Mesh& mesh);

std::vector<Triangle> triangles_of(const Mesh& mesh);

// The number of times that the surface winds around x (Van Oosterom and Strackee, "The solid angle
// of a plane triangle", IEEE Trans. Biomed. Eng. 30, 1983). It is close to a whole number unless x
// is on the surface.
double winding_number(const std::vector<Triangle>& surface, const Vec3d& x);

// The point of the triangle that is nearest to x, up to rounding.
Vec3d nearest_point(const Triangle& triangle, const Vec3d& x);

// A surface prepared for many distance queries.
class Surface {
 public:
  explicit Surface(std::vector<Triangle> triangles);
  // The distance in metres, up to rounding.
  double distance(const Vec3d& x) const;
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  std::vector<Triangle> triangles_;
  std::vector<Vec3d> centres_;
  std::vector<double> radii_;
};

// A point of a surface and the unit normal there (zero on a triangle without area).
struct SurfacePoint {
  Vec3d at, normal;
};
// The corners of every triangle, and `count` points spread evenly over the area. The result is
// deterministic.
std::vector<SurfacePoint> spread_points(const std::vector<Triangle>& surface, std::size_t count);

}  // namespace touchstone::geometry
