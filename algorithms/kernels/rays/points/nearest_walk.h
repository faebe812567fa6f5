// The nearest triangle of a mesh.
#pragma once

#include <cstdint>

#include "algorithms/kernels/rays/ray_mesh.h"

namespace touchstone::ray_tree {

struct Nearest {
  std::uint32_t triangle;
  Vec3d closest;  // its point that is nearest, in the mesh's coordinates, rounded
};

// The triangle that is nearest to a point whose numbers are finite, or one that is no farther but for the
// rounding of doubles. The mesh has triangles.
Nearest nearest_of(const RayMesh& mesh, const Vec3d& point);

}  // namespace touchstone::ray_tree
