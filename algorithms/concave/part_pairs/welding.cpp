// Welds: takes the normal of a face where the mesh does not support the contact's own.
//
// A triangle alone can be left sideways, across an edge behind which the surface goes on. A body that slides
// over that edge would be stopped by it, as by a step that is not there. Of the faces around the contact's point the one
// whose normal, on the body's side, is nearest to the contact's own has it: where a body lies on a box near its rim, that
// is the top, also for the triangle of the side.
//
// Fails: the body's side of a face is that of its origin, so that one whose origin is below is pushed further down. In a
// valley the face beside the one that the body lies on pushes already where the body reaches its edge alone. A contact
// at triangles without area keeps its own.
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
  const ConvexPart& convex = bodies_[other.body].given->parts[part];
  if (convex.shape.kind == ShapeKind::halfspace) return;
  const Pose pose = composed(other.pose, convex.pose, 0).pose;
  const MeshNeighbours::Face face =
      neighbours_[mesh.body]->nearest_face(triangle, mesh.pose, on_mesh, normal, pose.translation);
  const Vec3d& up = face.normal;
  if (up.isZero(0)) return;
  const Vec3d deepest = support_point(convex.shape, pose, -up);
  contact.normal = mesh_is_first ? up : Vec3d(-up);
  contact.depth = std::max(0.0, up.dot(face.corner - deepest));
  contact.point = deepest + 0.5 * contact.depth * up;
  contact.is_welded = true;
}

}  // namespace touchstone
