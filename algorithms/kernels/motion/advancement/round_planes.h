// The plane that is likely to part spheres and capsules for longest while they move. Used by the loop of
// conservative advancement (advancement.h).
//
// The plane of the closest points is soon left behind where bodies pass each other. That of the points which will be
// closest at first contact, or where the bodies are nearest, serves until then.
// Steps:   1. Go by Newton's method to the time at which the distance is nil, or if it does not become so, by the
//             secant of its rates to where it is least. Motions are taken to second order.
//          2. Keep the last normal along which the bodies are apart now.
// Fails:   it is a choice, not a proof.
// Cost:    three or four closest points of segments.
#pragma once

#include "algorithms/kernels/motion/advancement/pair_motion.h"
#include "algorithms/kernels/motion/advancement/round_cores.h"

namespace touchstone {

// For a pair that is round, whose closest points are `now` and apart by more than `least_gap`; it goes on for `left`
// of the whole time. The unit normal from a to b, along which they are apart by more than that too. Lengths are in the
// pair's unit.
Vec3d lasting_normal(SupportPair<double>& pair, const PairMotion& motion, const ClosestOfRound& now,
                     double left, double least_gap);

}  // namespace touchstone
