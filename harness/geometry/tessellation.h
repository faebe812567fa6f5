// Primitives as polytopes.
#pragma once

#include "algorithms/core/shape.h"

namespace touchstone {

// A hull that stands for a sphere, capsule, cylinder, cone, ellipsoid or box (metres, the same
// frame). Its vertices lie on the shape's surface, so it is inside the shape. A box gives 8
// vertices and 6 faces whatever the level (12 triangles). A sphere is an icosahedron whose
// triangles are split in four `level` times and projected: 12, 42, 162, 642, ... vertices and 20,
// 80, 320, ... faces; an ellipsoid is its image. A capsule is a sphere's, cut at the equator and
// drawn apart. Cylinder and cone have 8 * 2^level sides. A hull is returned as it is. Level is 0 to
// 5, or InputError; so is a half-space.
Shape as_polytope(const Shape& shape, int level);

}  // namespace touchstone
