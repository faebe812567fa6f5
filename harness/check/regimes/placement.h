// Places two bodies at a given gap or depth between two of their features.
#pragma once

#include "harness/base/random.h"
#include "harness/check/regimes/features.h"
#include "harness/files/cases.h"

namespace touchstone::check {

// Returns the rotation of b that turns b's normal against a's in the world, up to rounding. The
// rest of the turn aligns the two directions (`aligned`), or is random.
Mat3d facing(const Mat3d& rotation_a, const Feature& a, const Feature& b, bool aligned,
             base::Random& random);

// Translates b. The shapes, the rotations and the translation of a must be set, and the features
// must face each other. For gap >= 0 (metres) the features' surface points get the offset gap *
// normal, so that this is the bodies' distance. For gap < 0 the bodies overlap by that much along
// the normal. If that would not be the least depth, as between two vertices, or is more than a
// fiftieth of a body's width, b moves by -gap towards the middle of a instead, by at most nine
// tenths of the way.
//
// The offset is computed to about 1e-30 and rounded once. `fine` leaves that rounding to the
// translation of a, which becomes tiny: the difference of the two is then right far below an ulp.
void place(files::Case& c, const Feature& a, const Feature& b, double gap, bool fine);

// Translates b so that, along a random direction, the bodies are between well inside each other and
// well apart. With a half-space the direction is its normal.
void place_at_random(files::Case& c, base::Random& random);

}  // namespace touchstone::check
