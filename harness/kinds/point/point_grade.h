// The rule that decides whether an answer about a point and a mesh is right.
#pragma once

#include <span>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/point_query.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// A distance may be off by so many times the reach: some roundings of coordinates in the scalar of the algorithm.
inline constexpr double point_margin_double = 1e-14, point_margin_float = 1e-6;

// The greatest distance of the point and the mesh's vertices from the origin (metres).
double point_reach(const Vec3d& point, const TriangleMesh& mesh);

// `answer` and `exact` are of the same point; for the side both are of PointTask::side. Distances and `reach` are
// metres.
Graded grade_point(PointTask task, const PointAnswer& answer, const PointAnswer& exact,
                   Precision scalar, double reach);

}  // namespace touchstone::kinds
