// Part of part-pairs: a bound body, with what its queries need.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/kernels/triangles/exact_triangles.h"

namespace touchstone {

// A point of a connected piece of a body: of a mesh, or of a compound's surface or part.
struct PiecePoint {
  Vec3d point;  // in the coordinates of the part; of a mesh, in the body's
  std::uint32_t
      part;      // of a compound: the first of the surface. Points of one part follow each other.
  double reach;  // at least the greatest magnitude of a coordinate of the points of this part
};

// A surface whose inside belongs to its body.
struct SolidSurface {
  const TriangleMesh* mesh;
  std::uint32_t part;  // of a compound: the first of the surface, which has its pose
  double reach;        // the greatest magnitude of a coordinate of its vertices (metres)
};

struct BoundBody {
  explicit BoundBody(const ConcaveBody& body);

  // Computes the boxes and `reach` again such that the boxes, turned and moved with the body, enclose its
  // parts. Balls around cores are balls in the world, which boxes that the rotation shrinks do not
  // enclose. Returns false if they do already, as for each true rotation.
  bool enclose(const Mat3d& rotation);

  // Drops the boxes of a mesh, which `made_boxes` makes again.
  void drop_boxes() { boxes = std::vector<Aabb>(); }
  std::vector<Aabb> made_boxes() const;

  const ConcaveBody* given;
  std::vector<Aabb> boxes;  // of the parts, in body coordinates; none if they were dropped
  // At least the greatest magnitude of a coordinate of the body's points, apart from those of
  // half-spaces (metres).
  double reach = 0;
  std::vector<PiecePoint> pieces;  // one of each piece that is bounded
  std::vector<SolidSurface> solids;
  // The boxes are those of parts whose radii are this many times as large. That is a little more than
  // 1, so that rotations which were rounded to floats are enclosed.
  double radius_growth = 1 + 0x1p-18;

  const TriangleMesh* mesh() const { return given->mesh.get(); }
  // The place of a part under the body's pose, and the distance by which its points are off. `reach`
  // bounds their coordinates.
  ComposedPose place(const Pose& pose, std::uint32_t part, double reach) const;
  TriangleCorners corners(std::uint32_t triangle) const {
    const auto& at = mesh()->triangles[triangle];
    return {mesh()->vertices[at[0]], mesh()->vertices[at[1]], mesh()->vertices[at[2]]};
  }

 private:
  void fill_boxes();
  void add_pieces();
};

}  // namespace touchstone
