// Compounds: bodies of convex parts that are placed within each other.
#pragma once

#include <memory>
#include <optional>
#include <span>
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

}  // namespace touchstone::geometry
