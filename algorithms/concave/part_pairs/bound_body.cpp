// Boxes, reach and pieces of a body.
#include "algorithms/concave/part_pairs/bound_body.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "algorithms/core/bounds.h"

namespace touchstone {
namespace {

Aabb box_of(const TriangleCorners& corners) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    box.min[axis] = round_down(low);
    box.max[axis] = round_up(high);
  }
  return box;
}

Aabb box_of(const ConvexPart& part) {
  Aabb box = tight_box(part.shape, part.pose);
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = round_down(box.min[axis] - part.rounding);
    box.max[axis] = round_up(box.max[axis] + part.rounding);
  }
  return box;
}

// A corner of each piece of the mesh that its triangles' common corners connect.
std::vector<std::uint32_t> pieces_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> above(mesh.vertices.size());
  std::iota(above.begin(), above.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (above[v] != v) v = above[v] = above[above[v]];
    return v;
  };
  for (const auto& corners : mesh.triangles) {
    above[root(corners[1])] = root(corners[0]);
    above[root(corners[2])] = root(corners[0]);
  }
  std::vector<std::uint32_t> pieces;
  for (const auto& corners : mesh.triangles) {
    const std::uint32_t top = root(corners[0]);
    if (above[top] == top) pieces.push_back(top);
  }
  std::ranges::sort(pieces);
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

}  // namespace

BoundBody::BoundBody(const ConcaveBody& body) : given(&body) {
  boxes.reserve(body.part_count());
  if (body.mesh) {
    for (std::uint32_t i = 0; i < body.part_count(); ++i) boxes.push_back(box_of(corners(i)));
    for (const Vec3d& vertex : body.mesh->vertices) {
      reach = std::max(reach, vertex.cwiseAbs().maxCoeff());
    }
    pieces = pieces_of(*body.mesh);
    return;
  }
  for (const ConvexPart& part : body.parts) {
    boxes.push_back(box_of(part));
    for (const auto& corner : {boxes.back().min, boxes.back().max}) {
      for (const float x : corner) {
        if (std::isfinite(x)) reach = std::max(reach, double{std::abs(x)});
      }
    }
  }
}

}  // namespace touchstone
