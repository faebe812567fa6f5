// One pair of round bodies, or of a sphere and a box, cylinder or cone, in as little as the mathematics
// needs.
#pragma once

#include <limits>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Answers a pair of a sphere or capsule with another, or of a sphere with a box, cylinder or cone, a.kind <=
// b.kind, in double. Returns false, and leaves the outcome as it is, for all other kinds, and if that leaves
// the answer or a number open, such as within 1e-14 of the pair's size of contact. The bounds on the
// signed distance are at most 4e-14 of the sum of the pair's lengths apart. Bodies that are further
// apart than `margin` (metres) get no distance (write_beyond).
bool solve_plain_pair(Task task, const Shape& a, const Pose& pose_a, const Shape& b,
                      const Pose& pose_b, Outcome& outcome,
                      double margin = std::numeric_limits<double>::infinity());

}  // namespace touchstone
