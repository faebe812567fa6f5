// The rule that decides whether an answer about a ray and a mesh is right.
#pragma once

#include "algorithms/ray_cast.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// A t may be off by this share of t and of what the mesh's size is along the ray. Exact verdicts are held to the
// first in both scalars.
inline constexpr double ray_margin_exact = 1e-9, ray_margin_float = 1e-4;

// `exact` is the answer of RayTask::closest in the same scalar, whatever the task. `size` is that of the mesh, in
// lengths of the ray's direction.
Graded grade_ray(RayTask task, const RayHit& hit, const RayHit& exact, const RayCastEntry& entry,
                 Precision scalar, double size);

}  // namespace touchstone::kinds
