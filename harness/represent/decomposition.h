// A mesh as convex parts.
#pragma once

#include <vector>

#include "harness/represent/local_body.h"

namespace touchstone {

// Convex parts whose union certainly holds the solid of the mesh, in the body's local frame.
//
// Approximate convex decomposition by planes, as in Wei, Liu, Su, "Approximate convex decomposition
// for 3D meshes with collision-aware concavity and tree search", SIGGRAPH 2022; but concavity is
// the volume that the hull adds, cuts are chosen greedily (along three axes, and along the faces
// beside the sharpest concave edges), and parts are joined again while that adds little. A piece
// that is not closed is one part, its hull.
//
// Why it holds the solid: a cut puts a point on each edge that crosses it, once for both sides, and
// closes each side by triangles from the cut's rim to one point within it. So the windings of the
// two closed sides sum to that of the whole, wherever the points were rounded to; where a winding
// is not zero, that of a connected piece is not, and there one is in that piece's hull. What the
// rounding moves the surface by is added around each hull.
//
// `most` parts or, for 0, cuts until each hull has at most a hundredth of the body's volume too
// much, at most 64 parts.
std::vector<Part> decompose(const LocalBody& body, int most);

}  // namespace touchstone
