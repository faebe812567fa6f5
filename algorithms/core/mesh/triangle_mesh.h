// Triangle meshes: bodies that need not be convex, and what rays are cast at.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

// The union of closed triangles, in body coordinates (metres). Triangles may be degenerate, and may
// come twice.
struct TriangleMesh {
  std::vector<Vec3d> vertices;                          // finite
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of vertices
  // True if the points around which the surface winds belong to the body too. The surface is closed
  // then: each edge goes one way as often as the other.
  bool solid = false;
};

}  // namespace touchstone
