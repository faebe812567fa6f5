// Part of part-pairs: bodies inside of solid meshes.
#pragma once

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/core/pose.h"

namespace touchstone {

// True if a part of `body` is inside of the solid mesh. No part has a point of its surface, nor is one
// so near to it that the rounding of the part's pose hides this.
bool lies_inside(const BoundBody& body, const Pose& pose, const BoundBody& solid,
                 const Pose& pose_of_solid);

}  // namespace touchstone
