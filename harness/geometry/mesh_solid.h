// The solid that a mesh stands for.
#pragma once

#include <vector>

#include "harness/geometry/mesh.h"
#include "harness/geometry/polyhedron.h"

namespace touchstone {

// Triangles that hang together by edges are a part; where every edge is used as often in one
// direction as in the other the part is closed, and its solid is where its winding number is not
// zero. Of the parts that are not closed as the file has them, vertices at one place are made one;
// those that still are not enclose nothing of their own, so that their convex hull is their solid.
// The solid of the mesh is the union.
struct MeshPiece {
  Mesh mesh;
  bool closed = false;
};
std::vector<MeshPiece> pieces_of(const Mesh& mesh);

std::vector<Triangle> triangles_of(const Mesh& mesh);

// How often the surface winds about x (Van Oosterom and Strackee, "The solid angle of a plane
// triangle", IEEE Trans. Biomed. Eng. 30, 1983); near to a whole number unless x is on it.
double winding_number(const std::vector<Triangle>& surface, const Vec3d& x);

// The point of the triangle that is nearest to x, to rounding.
Vec3d nearest_point(const Triangle& triangle, const Vec3d& x);

// A surface that is asked for distances often.
class Surface {
 public:
  explicit Surface(std::vector<Triangle> triangles);
  // Metres, to rounding.
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
// The corners of every triangle, and `count` points spread evenly over the area, the same each
// time.
std::vector<SurfacePoint> spread_points(const std::vector<Triangle>& surface, std::size_t count);

}  // namespace touchstone
