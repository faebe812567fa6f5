// How a pair moves at a time. Used by the choice of planes (box_planes.h, round_planes.h).
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// Metres, and radians, in the whole time; world axes.
struct PairMotion {
  Vec3d velocity;        // of b's origin relative to a's
  Vec3d turn_a, turn_b;  // angular velocities
};

}  // namespace touchstone
