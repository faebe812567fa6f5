// Primitive shapes as polytopes, and shapes and bodies of another size. Used to draw, in scenes and as
// collision proxies.
#pragma once

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/shape.h"

namespace touchstone::geometry {

// Returns a hull that approximates a sphere, capsule, cylinder, cone, ellipsoid or box (metres,
// same frame). Its vertices lie on the shape's surface, so it is inside the shape. A box has 8
// vertices and 6 faces at every level (12 triangles). A sphere is an icosahedron whose triangles
// are split in four `level` times and projected: 12, 42, 162, 642, ... vertices and 20, 80, 320,
// ... faces; an ellipsoid is its image. A capsule is a sphere's points, cut at the equator and
// moved apart. Cylinder and cone have 8 * 2^level sides. A hull is returned unchanged. Throws
// InputError for a level outside 0 to 5 and for a half-space.
Shape as_polytope(const Shape& shape, int level);

// The shape with all lengths times the factor (> 0), about its body's origin. A hull's faces are found
// anew, as its vertices are rounded.
Shape scaled_shape(Shape shape, double factor);

// The body likewise.
ConcaveBody scaled_body(ConcaveBody body, double factor);

}  // namespace touchstone::geometry
