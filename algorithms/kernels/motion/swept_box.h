// Boxes of a body that moves for a step, and the boxes that they sweep in a part of it. Used by
// moving_pairs.
#pragma once

#include "algorithms/core/motion.h"
#include "algorithms/core/moving_box.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Returns a moving box that holds every point of the body at every time in [0, 1], whatever the
// rounding. Without rotation it is the body's tight box. With rotation it holds the body in every
// attitude of the step. A half-space that turns has an infinite box; one that moves is bounded only
// where its tight box is.
MovingBox moving_box_of(const Shape& shape, const Pose& pose, const Motion& motion);

// Returns a box that holds the moving box at all times from `begin` to `end`, with 0 <= begin <= end
// <= 1 and both multiples of 2^-20. The ends are rounded outward, and are finite: they are cut to the
// range of floats. Boxes that meet in that time overlap, cut or not.
Aabb swept_box_of(const MovingBox& body, double begin, double end);

}  // namespace touchstone
