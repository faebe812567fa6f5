// What a mesh has around a point of one of its triangles, and which normals it supports there. Used by
// `part-pairs`.
// Paper: Catto, "Ghost Collisions", box2d.org, 2020 (contacts at edges inside of a surface); Ericson, "Real-Time
//        Collision Detection", 2005, sec. 5.1.5 (the Voronoi regions of a triangle's features).
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/pose.h"

namespace touchstone {

// Vertices at the same place are one, so that a mesh whose triangles do not share vertices is whole too.
class MeshNeighbours {
 public:
  // The mesh stays alive and unchanged.
  explicit MeshNeighbours(const TriangleMesh& mesh);

  // True if all of the mesh that lies around the point is behind the plane through it with this normal, but
  // for a millionth of the distance. Around a point in a face that is its triangle, around one on an edge all
  // triangles that share it, around a vertex all that have it. The point (in the world, up to rounding) is one
  // of the triangle, the normal is a unit vector in the world.
  bool supports(std::uint32_t triangle, const Pose& pose, const Vec3d& point,
                const Vec3d& normal) const;

  // The plane of a triangle around the point, as above: of those with an area, seen from the side on which `from`
  // (world) is, the one whose normal is nearest to the given one. The normal is zero if none has an area.
  struct Face {
    Vec3d normal;  // unit vector in the world
    Vec3d corner;  // a point of the plane in the world
  };
  Face nearest_face(std::uint32_t triangle, const Pose& pose, const Vec3d& point,
                    const Vec3d& normal, const Vec3d& from) const;

 private:
  using Places = std::array<std::uint32_t, 3>;
  Places places_of(std::uint32_t triangle) const;
  // Calls visit(t) for the triangles that share the feature of this one on which the point is, as long as it
  // returns true. Returns whether it always did.
  template <class Visit>
  bool all_around(std::uint32_t triangle, const Pose& pose, const Vec3d& point,
                  const Visit& visit) const;

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> place_of_;                      // of each vertex: one of equal ones
  std::vector<std::pair<std::uint32_t, std::uint32_t>> at_;  // places with a triangle; ascending
};

}  // namespace touchstone
