// Boxes of bodies in their own coordinates, and around these in the world.
#include "algorithms/oracle/certificates/parts/body_box.h"

#include <cmath>

#include "algorithms/oracle/certificates/parts/placed_parts.h"
#include "algorithms/oracle/certificates/rational_pose.h"

namespace touchstone::oracle {
namespace {

// The box around the box in its place, and balls of this radius around all points there.
RationalBox placed(const RationalBox& box, const RationalPose& pose, const mpq_class& radius) {
  RationalBox world;
  for (std::size_t k = 0; k < 3; ++k) {
    const RationalVector& row = pose.rows[k];
    world.high[k] = pose.translation[k] + support(row, box) + radius;
    world.low[k] = pose.translation[k] - support(mpq_class(-1) * row, box) - radius;
  }
  return world;
}

// Not of an empty mesh. Least and greatest doubles are exact.
RationalBox box_of(const TriangleMesh& mesh) {
  Vec3d low = Vec3d::Constant(HUGE_VAL), high = -low;
  for (const auto& corners : mesh.triangles) {
    for (const std::uint32_t corner : corners) {
      require(corner < mesh.vertices.size(), "a triangle of the mesh names no vertex");
      const Vec3d& at = mesh.vertices[corner];
      require(at.allFinite(), "a number of a body or of a generator is not finite");
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
  }
  return {rational_vector(low), rational_vector(high)};
}

}  // namespace

std::optional<RationalBox> world_box(const ConcaveBody& body, const Pose& pose) {
  const RationalPose at = rational_pose(pose);
  if (body.part_count() == 0) return RationalBox{at.translation, at.translation};
  if (body.mesh) return placed(box_of(*body.mesh), at, 0);
  const PlacedParts parts(body, pose);
  std::optional<RationalBox> all = parts.boxes()[0];
  for (const auto& box : parts.boxes()) {
    if (!box) return {};
    all = around(*all, *box);
  }
  return placed(*all, at, parts.greatest_radius());
}

mpq_class support(const RationalVector& n, const RationalBox& box) {
  mpq_class sum;
  for (std::size_t k = 0; k < 3; ++k) sum += n[k] * (n[k] > 0 ? box.high[k] : box.low[k]);
  return sum;
}

}  // namespace touchstone::oracle
