// Mass properties and connected parts of meshes.
#pragma once

#include <vector>

#include "harness/geometry/mesh.h"

namespace touchstone::geometry {

// The centre of mass (in the mesh's units) of the solid that a closed mesh bounds. If the mesh is
// open or encloses no volume, so that the centre would be outside the mesh's box, it is that of its
// surface; if it has no surface either, it is the vertices' mean.
Vec3d centre_of_mass(const Mesh& mesh);

// The parts whose triangles are connected by shared edges, in the order of their first triangles,
// each with the vertices that it uses. Vertices without triangles are dropped.
std::vector<Mesh> connected_parts(const Mesh& mesh);

}  // namespace touchstone::geometry
