// How long a plane parts two turning bodies. Used by rigid-advancement and bilateral-advancement.
// Steps:   1. A point rho of a body moves in time h to rho + h w x rho + r, where |r| along n is at most
//             h^2 / 2 |n x w| |w| |rho|. So the body reaches no further along n than the support
//             value along n + h (n x w), plus that: the gap after h is at least
//               gap(h) = n . offset + h n . v - S_a(n + h n x w_a) - S_b(-n - h n x w_b) - k h^2 / 2.
//             Supports are convex functions, so gap is concave: what is proven at the end of a step holds
//             all along it.
//          2. Guess h by taking the support points as fixed, which is never too short. If the gap is
//             open there, go on there. Otherwise the chord from 0 gives an h at which it is open by
//             concavity; improve that by chords twice.
//          3. If balls about the bodies' origins stay apart along n for longer, take that time.
// Fails:   steps are short at many turns, where the bound k belongs to the whole body.
// Cost:    two to four support calls.
#pragma once

#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

// A plane that parts the bodies at a time.
struct PartingPlane {
  double time;
  Vec3d normal;  // unit vector from a to b
  double gap;    // metres; proven beyond rounding, > 0
};

// How long a plane parts the bodies.
struct FreeUntil {
  double time;      // they are apart in [plane.time, time)
  bool to_the_end;  // they are apart in [plane.time, 1]
};

// `pair` is at the plane's time. The time is the plane's own if nothing is proven.
FreeUntil longest_step(const RelativeMotion& motion, SupportPair<double>& pair,
                       const PartingPlane& plane);

}  // namespace touchstone
