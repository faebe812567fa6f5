// Used by gjk-ray-cast and mpr-ray-cast: proofs about bodies in contact, by GJK at fixed times.
#pragma once

#include "algorithms/kernels/motion/linear/moving_pair.h"

namespace touchstone {

// Returns true if it finds a plane along which the bodies are no deeper than the tolerance (in the
// pair's unit) in each other at time 0 and at time 1, and so at any time between. GJK finds it:
// between the difference and the segment that the offset moves along.
bool never_deeper(MovingPair& pair, double tolerance, int most_iterations, int& iterations);

// Returns true if the bodies share a point at that time, whatever rounding did: the hull of a point of
// the simplex and of the ball inside of the difference contains the origin, or a tetrahedron surely does,
// or a point is nearer than the radii. The simplex is that of an earlier time, and GJK starts there. It
// leaves the pair at the new time.
bool contact_is_proven(MovingPair& pair, Simplex<double> simplex, double time, int& iterations);

}  // namespace touchstone
