// Part of closed-form: two boxes whose faces meet within rounding.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Solves any task for boxes that are nearly at contact at a face, as BoxPairLanes does in lanes.
// Returns false, and leaves the outcome as it is, for other pairs, and where a bound is open.
bool solve_plain_box_rest(Task task, const Shape& a, const Pose& pose_a, const Shape& b,
                          const Pose& pose_b, Outcome& outcome);

}  // namespace touchstone
