// Part of exact concave: bodies inside of solid meshes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"

namespace touchstone::oracle {

// A point of a connected piece of a body, in the coordinates of one of a compound's parts, or of a mesh.
struct Piece {
  Vec3d point;
  std::uint32_t part;  // 0 of a mesh
};

// One of each piece: of each connected piece of a mesh, also in a compound, and of each bounded part that is
// in no mesh.
std::vector<Piece> pieces_of(const ConcaveBody& body);

// True if a solid mesh that is `outer`, or among its parts, winds around one of the points of `inner`. None
// is on it, nor so near that the rounding of poses hides its side; with `only_exact` some may be, and
// poses that are rounded do not count.
bool is_inside(const ConcaveBody& inner, std::span<const Piece> pieces, const Pose& pose_inner,
               const ConcaveBody& outer, const Pose& pose_outer, bool only_exact);

}  // namespace touchstone::oracle
