// Points of pieces, and how often solid meshes wind around them.
#include "algorithms/oracle/concave/inside.h"

#include <algorithm>
#include <numeric>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/oracle/concave/exact_winding.h"

namespace touchstone::oracle {
namespace {

// A vertex of each piece of the mesh that hangs together by shared vertices.
std::vector<std::uint32_t> one_of_each_piece(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& corners : mesh.triangles) {
    parent[root(corners[1])] = root(corners[0]);
    parent[root(corners[2])] = root(corners[0]);
  }
  std::vector<std::uint32_t> pieces;
  for (const auto& corners : mesh.triangles) pieces.push_back(root(corners[0]));
  std::ranges::sort(pieces);
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

struct PlacedPart {
  Pose pose;
  bool is_exact;
};

PlacedPart placed(const ConcaveBody& body, std::uint32_t part, const Pose& pose) {
  if (body.mesh) return {pose, true};
  const ConvexPart& given = body.parts[part];
  const ComposedPose found = composed(pose, given.pose, 1);
  return {found.pose, found.error == 0 && given.rounding == 0};
}

}  // namespace

std::vector<Piece> pieces_of(const ConcaveBody& body) {
  std::vector<Piece> pieces;
  const auto add_mesh = [&](const TriangleMesh& mesh, std::uint32_t part) {
    for (const std::uint32_t vertex : one_of_each_piece(mesh)) {
      pieces.push_back({mesh.vertices[vertex], part});
    }
  };
  if (body.mesh) add_mesh(*body.mesh, 0);
  std::vector<bool> is_of_mesh(body.parts.size());
  for (const CompoundSurface& surface : body.surfaces) {
    add_mesh(*surface.mesh, surface.first);
    std::fill_n(is_of_mesh.begin() + surface.first, surface.mesh->triangles.size(), true);
  }
  for (std::uint32_t i = 0; i < body.parts.size(); ++i) {
    const Shape& shape = body.parts[i].shape;
    if (is_of_mesh[i] || shape.kind == ShapeKind::halfspace) continue;
    const bool is_hull = shape.kind == ShapeKind::hull;
    pieces.push_back({is_hull ? shape.hull->vertices[0] : Vec3d(Vec3d::Zero()), i});
  }
  return pieces;
}

bool is_inside(const ConcaveBody& inner, std::span<const Piece> pieces, const Pose& pose_inner,
               const ConcaveBody& outer, const Pose& pose_outer, bool only_exact) {
  const auto holds_a_piece = [&](const TriangleMesh& mesh, std::uint32_t part) {
    const PlacedPart solid = placed(outer, part, pose_outer);
    return std::ranges::any_of(pieces, [&](const Piece& piece) {
      const PlacedPart place = placed(inner, piece.part, pose_inner);
      if (only_exact && !(solid.is_exact && place.is_exact)) return false;
      return exact_winding(mesh, solid.pose, piece.point, place.pose) != 0;
    });
  };
  if (outer.mesh) return outer.mesh->solid && holds_a_piece(*outer.mesh, 0);
  return std::ranges::any_of(outer.surfaces, [&](const CompoundSurface& surface) {
    return surface.mesh->solid && holds_a_piece(*surface.mesh, surface.first);
  });
}

}  // namespace touchstone::oracle
