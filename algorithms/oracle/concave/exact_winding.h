// Part of the oracle: how often a closed surface winds around a point, in integers.
#pragma once

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/pose.h"

namespace touchstone::oracle {

// The winding number of the mesh, under its pose, around a point under another pose; every number is
// taken literally. The mesh is closed, and the point is not on it.
int exact_winding(const TriangleMesh& mesh, const Pose& pose, const Vec3d& point,
                  const Pose& pose_of_point);

}  // namespace touchstone::oracle
