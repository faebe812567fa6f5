// One capsule and one box, in as little as the mathematics needs.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Answers a pair of a capsule and a box, in double; bodies that are further apart than `margin` (metres)
// get no distance (write_beyond). Returns false, and leaves the outcome as it is, if
// that leaves the answer or a number open: within 2e-14 of the pair's size of contact, cores that are
// nearer to each other than a thousandth of it where a number is asked for, a matrix that is no rotation
// within 1e-15 where the segment meets the box, or numbers that overflow. The bounds on the signed
// distance are at most 7e-14 of the sum of the pair's lengths apart.
using PlainCapsuleBox = bool (*)(Task task, const Shape& capsule, const Pose& pose_a,
                                 const Shape& box, const Pose& pose_b, Outcome& outcome,
                                 double margin);

// Returns the function for the active level of vector instructions.
PlainCapsuleBox plain_capsule_box();

}  // namespace touchstone
