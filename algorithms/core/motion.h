// The motion of a body from its pose at time 0 to time 1.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// At time t the body's origin is at translation + t * displacement and its rotation is
// exp(t * rotation_vector) * rotation: it turns evenly about its own origin, about an axis that is
// fixed in the world, by any number of turns.
struct Motion {
  Vec3d displacement = Vec3d::Zero();     // metres, world axes
  Vec3d rotation_vector = Vec3d::Zero();  // radians, world axes

  bool turns() const { return !rotation_vector.isZero(0); }
};

}  // namespace touchstone
