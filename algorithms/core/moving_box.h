// Boxes that move for a step: the input of a broad phase of motion. Everything may include this.
#pragma once

#include <array>

#include "algorithms/core/aabb.h"

namespace touchstone {

// At time t in [0, 1] it is the closed box [min + t * displacement, max + t * displacement], in
// exact arithmetic (metres). All its numbers are floats, so that a few products of doubles decide
// whether two of them meet.
struct MovingBox {
  Aabb box;  // at time 0; an end may be infinite
  std::array<float, 3> displacement = {0, 0, 0};
  float padding = 0;  // a body is ten floats, read as three overlapping quads
};
static_assert(sizeof(MovingBox) == 10 * sizeof(float));

}  // namespace touchstone
