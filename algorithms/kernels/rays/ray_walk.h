// Walks of rays through a wide tree of triangles.
#pragma once

#include <span>

#include "algorithms/kernels/rays/points/winding_query.h"
#include "algorithms/kernels/rays/ray_block.h"
#include "algorithms/kernels/rays/ray_mesh.h"
#include "algorithms/kernels/rays/ray_query.h"

namespace touchstone::ray_tree {

// Writes the hit of each ray. The rays are taken as they are; at most RayBlock::most, at least one.
void cast_each(const RayMesh& mesh, RayTask task, std::span<const Ray> rays,
               std::span<RayHit> hits);

// Tells each query of the triangles above its point, and offers it those that may be. At most RayBlock::most, at least one.
void wind_each(const RayMesh& mesh, std::span<WindingQuery> queries);

}  // namespace touchstone::ray_tree
