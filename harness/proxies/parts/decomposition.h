// Decomposes a mesh into convex parts.
#pragma once

#include <vector>

#include "harness/proxies/local_body.h"

namespace touchstone::proxies {

// Returns convex parts whose union certainly contains the solid of the mesh, in the body's local
// frame.
//
// The method is approximate convex decomposition by planes, as in Wei, Liu, Su, "Approximate convex
// decomposition for 3D meshes with collision-aware concavity and tree search", SIGGRAPH 2022. Here
// concavity is the volume that the hull adds, the search for a cut looks ahead by one more
// (cut_choice.h), and parts are joined again while that adds little. A piece that is not closed
// becomes one part, its hull. A sliver that a cut left becomes a box.
//
// The parts contain the solid for this reason: at a point with a nonzero winding number of the
// mesh, one of the pieces has a nonzero winding number (mesh_cut.h), so the point is in that
// piece's hull. The error of rounding the cuts is added around each hull.
//
// `most` limits the number of parts. For 0, cuts continue until each hull has at most a hundredth
// of the body's volume too much, with at most 64 parts or as many as the mesh has disconnected
// pieces.
std::vector<Part> decompose(const LocalBody& body, int most);

}  // namespace touchstone::proxies
