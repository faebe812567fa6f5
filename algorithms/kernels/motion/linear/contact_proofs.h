// Used by gjk-ray-cast and mpr-ray-cast: the proof that bodies are in contact at a time.
#pragma once

#include "algorithms/kernels/motion/linear/moving_pair.h"

namespace touchstone {

// Returns true if the bodies share a point at that time, whatever rounding did: the hull of a point of
// the simplex and of the ball inside of the difference contains the origin, or a tetrahedron surely does,
// or a point is nearer than the radii. The simplex is that of an earlier time, and GJK starts there. It
// leaves the pair at the new time.
bool contact_is_proven(MovingPair& pair, Simplex<double> simplex, double time, int& iterations);

}  // namespace touchstone
