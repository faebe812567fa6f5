// A closed mesh cut by a plane into closed meshes.
#pragma once

#include <vector>

#include "harness/geometry/mesh.h"
#include "harness/geometry/polyhedron.h"

namespace touchstone {

// The connected pieces on both sides of the plane, moved by a few millionths of the mesh's size if
// need be so that it keeps clear of all vertices; none where it cuts nothing.
//
// A point is put on each edge that crosses the plane, once for both sides, and each side is closed
// by triangles from each loop of its rim to the loop's middle. So the winding numbers of the pieces
// sum to that of the mesh with those points in it, wherever they were rounded to: by less than 8
// units in the last place of the greatest coordinate. Triangles that close a rim which is not
// convex may reach over it, and cancel; volumes are true.
std::vector<Mesh> cut(const Mesh& mesh, Plane plane);

}  // namespace touchstone
