// Bodies as the page draws them.
#pragma once

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/files/json_line.h"
#include "harness/geometry/mesh.h"

namespace touchstone::report {

// The shape's numbers in body coordinates, with the faces of a hull. A hull that came without faces
// gets those of the convex hull of its vertices; one that is flat has none.
files::OrderedJson shape_view(const Shape& shape);
// A mesh as the page draws it: a polytope of its triangles.
files::OrderedJson mesh_view(const geometry::Mesh& mesh);
files::OrderedJson body_view(const Shape& shape, const Pose& pose);

// A vector, or null if a number in it is not finite.
files::OrderedJson triple(const Vec3d& v);
// A number, or null if it is not finite.
files::OrderedJson number(double x);

}  // namespace touchstone::report
