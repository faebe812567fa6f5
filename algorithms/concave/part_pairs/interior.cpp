// Bodies inside of solid meshes: a connected body that does not meet the surface is inside as a
// whole, or outside, so that one point of each of its pieces tells.
#include "algorithms/concave/part_pairs/interior.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/triangles/winding.h"

namespace touchstone {
namespace {

// A point of a bounded convex shape, in its own coordinates.
Vec3d point_of(const Shape& shape) {
  return shape.kind == ShapeKind::hull ? shape.hull->vertices[0] : Vec3d::Zero();
}

}  // namespace

bool lies_inside(const BoundBody& body, const Pose& pose, const BoundBody& solid,
                 const Pose& pose_of_solid) {
  const CommonFrame frame = common_frame(pose_of_solid, solid.reach, pose, body.reach);
  const auto winds = [&](const Vec3d& point, const Pose& pose_of_point) {
    return winding_number(*solid.mesh(), pose_of_solid, point, pose_of_point, solid.reach) != 0;
  };
  if (body.mesh() != nullptr) {
    return std::ranges::any_of(body.pieces, [&](std::uint32_t corner) {
      const Vec3d& point = body.mesh()->vertices[corner];
      // A point further out than any of the solid's is not inside.
      if (frame.is_of_a && (frame.b(point).cwiseAbs().array() > solid.reach + frame.error).any()) {
        return false;
      }
      return winds(point, pose);
    });
  }
  for (const ConvexPart& part : body.given->parts) {
    if (part.shape.kind == ShapeKind::halfspace) continue;  // it is not bounded
    // A place that is rounded is good enough: the part is further from the surface than that.
    if (winds(point_of(part.shape), composed(pose, part.pose, body.reach).pose)) return true;
  }
  return false;
}

}  // namespace touchstone
