// Mass properties and parts of meshes.
#pragma once

#include <vector>

#include "harness/geometry/mesh.h"

namespace touchstone {

// The centre of mass (in the mesh's units) of the solid that a closed mesh bounds; where the mesh
// encloses no volume or is open, so that it would be outside the mesh's box, that of its surface;
// where it has no surface either, the vertices' mean.
Vec3d centre_of_mass(const Mesh& mesh);

// The parts whose triangles hang together by shared edges, in the order of their first triangles,
// each with the vertices that it uses. Vertices without triangles are lost.
std::vector<Mesh> connected_parts(const Mesh& mesh);

}  // namespace touchstone
