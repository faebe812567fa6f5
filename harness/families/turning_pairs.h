// Moving pairs of which one turns, with a known answer.
#pragma once

#include "harness/families/moving_pairs.h"

namespace touchstone::families {

// Bodies of any two kinds that turn by so many radians; the answer is not known.
MovingPairCase turning(ShapeKind a, ShapeKind b, double radians, Draws& random);

// A needle that turns in place reaches a ball when its axis is a radius away from the ball.
MovingPairCase turning_needle(bool hit, Draws& random);

// Turns of many times: a rod that sinks while it turns above a plate, and meets it at a known time.
MovingPairCase sinking_rod(bool hit, Draws& random);

// A body whose origin is far outside of it, by up to 10^4 times the ball that it comes to.
MovingPairCase far_pivot(bool hit, Draws& random);

// A corner of a turning box passes a plate at the gap, or scratches it, for a negative one.
MovingPairCase passing_corner(double gap);

}  // namespace touchstone::families
