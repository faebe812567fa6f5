// A mesh as convex parts.
#pragma once

#include <vector>

#include "harness/proxies/local_body.h"

namespace touchstone {

// Convex parts whose union certainly holds the solid of the mesh, in the body's local frame.
//
// Approximate convex decomposition by planes, as in Wei, Liu, Su, "Approximate convex decomposition
// for 3D meshes with collision-aware concavity and tree search", SIGGRAPH 2022; but concavity is
// the volume that the hull adds, cuts are chosen greedily (along three axes, and along the faces
// beside the sharpest concave edges), and parts are joined again while that adds little. A piece
// that is not closed is one part, its hull.
//
// Why it holds the solid: where the winding number of the mesh is not zero, that of one of the
// pieces that it is cut into is not (mesh_cut.h), and there one is in that piece's hull. What the
// rounding of cuts moves the surface by is added around each hull.
//
// `most` parts or, for 0, cuts until each hull has at most a hundredth of the body's volume too
// much, at most 64 parts, or as many as the mesh has pieces that do not hang together.
std::vector<Part> decompose(const LocalBody& body, int most);

}  // namespace touchstone
