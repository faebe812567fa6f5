// What a mesh has around a point of one of its triangles, and which normals it supports there. Used by
// `part-pairs`.
// Paper: Catto, "Ghost Collisions", box2d.org, 2020 (contacts at edges inside of a surface); Ericson, "Real-Time
//        Collision Detection", 2005, sec. 5.1.5 (the Voronoi regions of a triangle's features).
#pragma once

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

 private:
  struct Edge {
    std::uint32_t low, high;  // places, low < high
    std::uint32_t apex;       // the place of a triangle's third corner
  };

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> place_of_;  // of each vertex: one of equal ones
  std::vector<Edge> edges_;              // ascending
  std::vector<std::pair<std::uint32_t, std::uint32_t>> beside_;  // places with an edge; ascending
};

}  // namespace touchstone
