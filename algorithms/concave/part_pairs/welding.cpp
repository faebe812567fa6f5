// Welds: takes the normal of the face where the mesh does not support the contact's own.
//
// A triangle alone can be left sideways, across an edge behind which the surface goes on. A body that slides
// over that edge would be stopped by it, as by a step that is not there.
//
// Fails: a body whose origin is below the face is pushed further down. In a valley the face beside the one that
// the body lies on pushes already where the body reaches its edge alone. A triangle without area keeps its contact.
#include "algorithms/concave/part_pairs/welding.h"

#include <algorithm>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/common_frame.h"

namespace touchstone {

void Welding::bind(std::span<const BoundBody> bodies) {
  bodies_ = bodies;
  neighbours_.clear();
  for (const BoundBody& body : bodies) {
    std::optional<MeshNeighbours>& neighbours = neighbours_.emplace_back();
    if (body.mesh() != nullptr) neighbours.emplace(*body.mesh());
  }
}

void Welding::mend(const PlacedConcave& a, const Vec3d& on_a, const PlacedConcave& b,
                   const Vec3d& on_b, PartContact& contact) const {
  const bool first = neighbours_[a.body].has_value(), second = neighbours_[b.body].has_value();
  if (first == second || !contact.normal.allFinite()) return;
  const auto& [part_a, part_b] = contact.parts;
  if (first) {
    mend({a, b, part_a, part_b, on_a, contact.normal}, true, contact);
  } else {
    mend({b, a, part_b, part_a, on_b, -contact.normal}, false, contact);
  }
}

void Welding::mend(const MeshContact& of_mesh, bool mesh_is_first, PartContact& contact) const {
  const auto& [mesh, other, triangle, part, on_mesh, normal] = of_mesh;
  if (neighbours_[mesh.body]->supports(triangle, mesh.pose, on_mesh, normal)) return;
  const TriangleCorners corners = bodies_[mesh.body].corners(triangle);
  const Vec3d p = mesh.pose(corners[0]);
  const Vec3d across = (mesh.pose(corners[1]) - p).cross(mesh.pose(corners[2]) - p);
  const double area = across.norm();
  // A triangle without area has no face.
  if (!(area > 0)) return;
  const ConvexPart& convex = bodies_[other.body].given->parts[part];
  if (convex.shape.kind == ShapeKind::halfspace) return;
  const Pose pose = composed(other.pose, convex.pose, 0).pose;
  const bool above = across.dot(pose.translation - p) >= 0;
  const Vec3d up = across / (above ? area : -area);
  const Vec3d deepest = support_point(convex.shape, pose, -up);
  contact.normal = mesh_is_first ? up : Vec3d(-up);
  contact.depth = std::max(0.0, up.dot(p - deepest));
  contact.point = deepest + 0.5 * contact.depth * up;
  contact.is_welded = true;
}

}  // namespace touchstone
