// Whether two boxes meet, one pair at a time.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Says whether two boxes are apart or overlap. Returns `unknown` if rounding leaves it open: within 2e-13
// of the pair's size of contact, nearly parallel edges that decide, a matrix that is no rotation within
// 1e-14, or numbers that overflow; in float within about 1e-4.
struct PlainBoxes {
  using Function = Answer (*)(const Shape& a, const Pose& pose_a, const Shape& b,
                              const Pose& pose_b);
  Function in_float, in_double;
};

// Returns the functions for the active level of vector instructions.
PlainBoxes plain_boxes();

}  // namespace touchstone
