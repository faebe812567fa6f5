// Bodies that need not be convex: compounds, which are convex parts placed within each other, and
// meshes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "algorithms/core/mesh/concave_body.h"
#include "harness/geometry/mesh.h"

namespace touchstone::geometry {

// Moves a part that lies within compounds of these poses, the outermost first, to the outermost
// one's frame, and adds what that rounds to the part's bound.
void place_within(std::span<const Pose> around, ConvexPart& part);

// Adds the triangles of a mesh with this pose that lies within compounds of the poses `around`, as above.
void add_surface(std::shared_ptr<const TriangleMesh> mesh, const Pose& pose,
                 std::span<const Pose> around, ConcaveBody& compound);

// The surfaces of all parts of a compound in its frame, each closed by itself, and its meshes as they are.
// Round parts are polytopes, whose vertices lie on them; half-spaces are left out.
Mesh surface_of(const ConcaveBody& compound);

// Returns the ends of an edge that the surface does not go along as often one way as the other;
// nothing if it is closed. Vertices in one place count as one.
std::optional<std::pair<Vec3d, Vec3d>> open_edge(
    std::span<const Vec3d> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);

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
