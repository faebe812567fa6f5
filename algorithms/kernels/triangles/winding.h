// How often a closed surface winds around a point, exactly.
// Source: crossings along a ray, with the half-open rule of Sunday, "Inclusion of a point in a
//         polygon", 2001, which counts a ray through an edge or a corner once.
#pragma once

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/pose.h"

namespace touchstone {

// The winding number of the mesh, under its pose, around a point under another pose; every number is
// taken literally. The mesh is closed, and the point is not on it. `reach` is at least the greatest
// magnitude of a coordinate of the mesh's vertices (metres).
int winding_number(const TriangleMesh& mesh, const Pose& pose, const Vec3d& point,
                   const Pose& pose_of_point, double reach);

}  // namespace touchstone
