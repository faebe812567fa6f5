// Part of part-pairs: contacts of a mesh that heed the triangles around.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/concave_phase.h"
#include "algorithms/kernels/triangles/mesh_neighbours.h"

namespace touchstone {

class Welding {
 public:
  // The bodies stay alive, and their meshes unchanged.
  void bind(std::span<const BoundBody> bodies);

  // Mends the contact of a mesh and a convex part, in either order; `on_a` and `on_b` are its witness points
  // in the world. Contacts of two meshes, or of none, stay as they are.
  void mend(const PlacedConcave& a, const Vec3d& on_a, const PlacedConcave& b, const Vec3d& on_b,
            PartContact& contact) const;

 private:
  // `normal` goes from the mesh to the part.
  struct MeshContact {
    const PlacedConcave &mesh, &other;
    std::uint32_t triangle, part;
    Vec3d on_mesh, normal;
  };
  void mend(const MeshContact& of_mesh, bool mesh_is_first, PartContact& contact) const;

  std::span<const BoundBody> bodies_;
  std::vector<std::optional<MeshNeighbours>> neighbours_;  // of each mesh
};

}  // namespace touchstone
