// Bodies from meshes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "algorithms/core/mesh/concave_body.h"
#include "harness/geometry/mesh.h"

namespace touchstone::geometry {

// What a mesh is.
enum class MeshUse : std::uint8_t {
  surface,   // its triangles
  solid,     // these and what they wind around
  hull,      // its convex hull
  compound,  // the convex hulls of its connected parts, as one body
};
inline constexpr std::array<std::string_view, 4> mesh_use_names = {"surface", "solid", "hull",
                                                                   "compound"};

// Of a hull: a body of one part. Hulls have only their corners.
ConcaveBody mesh_body(const Mesh& mesh, MeshUse use);

}  // namespace touchstone::geometry
