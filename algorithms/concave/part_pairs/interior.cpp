// Bodies inside of solid meshes: a connected body that does not meet the surface is inside as a
// whole, or outside, so that one point of each of its pieces tells.
//
// Places that are rounded are good enough where nothing is nearer to a surface than that: on the way to the
// exact places no point crosses it.
#include "algorithms/concave/part_pairs/interior.h"

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/triangles/winding.h"

namespace touchstone {
namespace {

bool holds_a_piece(const SolidSurface& solid, const Pose& pose_of_solid, const BoundBody& body,
                   const Pose& pose, bool only_exact) {
  ComposedPose place = {};
  CommonFrame frame;
  const PiecePoint* last = nullptr;
  for (const PiecePoint& piece : body.pieces) {
    if (last == nullptr || last->part != piece.part) {
      place = body.place(pose, piece.part, piece.reach);
      frame = common_frame(pose_of_solid, solid.reach, place.pose, piece.reach);
    }
    last = &piece;
    if (only_exact && place.error > 0) continue;
    // A point further out than any of the solid's is not inside.
    const Vec3d seen = frame.b(piece.point).cwiseAbs();
    if (frame.is_of_a && (seen.array() > solid.reach + frame.error).any()) continue;
    if (winding_number(*solid.mesh, pose_of_solid, piece.point, place.pose, solid.reach) != 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool lies_inside(const BoundBody& body, const Pose& pose, const BoundBody& around,
                 const Pose& pose_around, bool only_exact) {
  for (const SolidSurface& solid : around.solids) {
    const ComposedPose place = around.place(pose_around, solid.part, solid.reach);
    if (only_exact && place.error > 0) continue;
    if (holds_a_piece(solid, place.pose, body, pose, only_exact)) return true;
  }
  return false;
}

}  // namespace touchstone
