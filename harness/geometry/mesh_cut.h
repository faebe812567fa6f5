// Cuts a closed mesh by a plane into closed meshes. Used by harness/proxies.
#pragma once

#include <vector>

#include "harness/geometry/mesh.h"
#include "harness/geometry/polyhedron.h"

namespace touchstone::geometry {

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
