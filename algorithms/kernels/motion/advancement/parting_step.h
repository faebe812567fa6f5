// How long a plane parts two turning bodies. Used by rigid-advancement and bilateral-advancement.
// Steps:   1. The plane's normal n may turn too, with the angular velocity w, as where it belongs to a face of a body;
//             then all is seen from what turns with n. A point rho of a body that turns with v moves in time h to
//             rho + h (v - w) x rho + r, where |r| along n is at most
//             h^2 / 2 (|v - w|^2 + |w x v|) |rho|, and for w = 0 at most h^2 / 2 |n x v| |v| |rho|. So the body reaches
//             no further along n than the support value along n + h n x (v - w), plus that. The offset o of the
//             origins, which moves with u, has along n at least
//             n . o + h n . (u - w x o) - h^2 / 2 |n x w| (|w| |o| + 2 |u|), with the greatest |o|. So the gap is at least
//               gap(h) = n . o + h n . (u - w x o) - S_a(n + h n x (v_a - w)) - S_b(-n - h n x (v_b - w)) - k h^2 / 2.
//             Supports are convex functions, so gap is concave: what is proven at the end of a step holds
//             all along it.
//          2. Where the plane closes, the gap is taken to second order: as seen from a body, n turns to
//               n + h n' + h^2 / 2 n'',  n' = (w - v) x n,  n'' = -v x n' - (v - w) x (w x n),
//             up to h^3 / 6 (|v| + |w|) times the bound above, and so for the offset. That bound on the gap at h alone
//             is not concave. But the true gap less k t^2 / 2 is, so at t = s h it is at least
//               (1 - s) (gap(0) - s k h^2 / 2) + s gap(h),
//             which is open for all s in [0, 1] if gap(h) is and k h^2 / 2 is at most gap(0). Guess h by taking the
//             support points as fixed, and go back by Newton's method until it is so.
//          3. Otherwise take the concave bound. The guess with fixed support points is never too short. If the gap is
//             open there, go on there; if not the chord from 0 gives an h at which it is open by
//             concavity; one more chord improves it.
//          4. If balls about the bodies' origins stay apart along the fixed n for longer, take that time.
// Fails:   steps are short at many turns, where the bound k belongs to the whole body.
// Cost:    two to five support calls.
#pragma once

#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

// A plane that parts the bodies at a time.
struct PartingPlane {
  double time;
  Vec3d normal;  // unit vector from a to b
  double gap;    // metres; proven beyond rounding, > 0
  // The angular velocity with which the normal's features turn (radians in the whole time, world axes), or zero.
  Vec3d turning = Vec3d::Zero();
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
