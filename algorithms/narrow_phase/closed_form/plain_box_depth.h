// The depth of two boxes in each other, one pair at a time.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Writes the least depth of two boxes that overlap, with normal, points and bounds, in double. Returns
// false, and leaves the outcome as it is, if they do not, or if that leaves a number open: within 2e-14
// of the pair's size of contact, a matrix that is no rotation within 1.5e-15, numbers that overflow, or
// points that rounding moves off the boxes. The bounds on the signed distance are at most 7e-14 of the
// sum of the pair's lengths apart.
bool solve_plain_box_depth(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                           Outcome& outcome);

}  // namespace touchstone
