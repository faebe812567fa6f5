// Part of gjk-ray-cast: whether bodies that begin in contact approach.
#pragma once

#include "algorithms/cast/gjk_ray_cast/moving_pair.h"

namespace touchstone {

// Returns true if it finds a plane along which the bodies are no deeper than the tolerance (in the
// pair's unit) in each other at time 0 and at time 1, and so at any time between. GJK finds it:
// between the difference and the segment that the offset moves along.
bool never_deeper(MovingPair& pair, double tolerance, int most_iterations, int& iterations);

}  // namespace touchstone
