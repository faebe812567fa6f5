// The upper end of a bracket of the time of impact: a time by which two bodies are proven to share
// a point. Used by the loop of
// conservative advancement (advancement.h).
// Steps:   1. Try a time a little after the found contact, to which the bodies carry the points that were nearest.
//             If these are nearer than the balls around the cores are wide, or their difference is in front of the
//             ball inside of the cores' (inner_ball.h), or one of them is in the other body, a box, that is a proof.
//          2. Run GJK there. A tetrahedron of the cores' difference around the origin, or a point of
//             it nearer to the origin than the radii, is a proof if it holds beyond rounding.
//          3. Otherwise try a time further on, until the end of the motion.
// Fails:   there may be no such time, as for bodies that graze and for flat ones in a plane.
// Cost:    one GJK verdict where the bodies meet squarely, at most seven.
#pragma once

#include <optional>

#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

// Returns true if the bodies share a point, whatever rounding did. `slack` is how far the pair's
// placement is off (metres). Adds to `iterations`.
bool contact_is_proven(SupportPair<double>& pair, double slack, int& iterations);

// The points of the cores that were nearest to each other at a time: metres, world axes, each from its
// own body's origin.
struct NearestPoints {
  double time;
  Vec3d a, b;
};

// Returns a time in [nearest.time, 1] at which they do, or nothing. The first try is a step later.
std::optional<double> contact_by(const RelativeMotion& motion, const NearestPoints& nearest,
                                 double step, int& iterations);

}  // namespace touchstone
