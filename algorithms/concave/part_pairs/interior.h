// Part of part-pairs: bodies inside of solid meshes.
#pragma once

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/core/pose.h"

namespace touchstone {

// True if a piece of `body` is inside of a solid surface of `around`. No part has a point of such a
// surface, nor is one so near to it that the rounding of a part's pose hides this. With `only_exact` one
// may be: then pieces and surfaces count whose poses are not rounded.
bool lies_inside(const BoundBody& body, const Pose& pose, const BoundBody& around,
                 const Pose& pose_around, bool only_exact);

}  // namespace touchstone
