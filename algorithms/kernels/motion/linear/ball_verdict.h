// What balls around the bodies and balls inside of them tell of a pair that moves without turning, before
// anything else is prepared. Used by gjk-ray-cast and mpr-ray-cast.
#pragma once

#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

enum class BallVerdict : std::uint8_t {
  open,
  miss,     // a plane parts the outer balls at any time
  overlap,  // at time 0 the inner balls overlap by more than the tolerance
};

// `offset` is that of the centres at time 0, `reach` the sum of the bodies' outer_reach; the tolerance is in
// metres. Where squares of lengths have no digits the verdict is open.
BallVerdict ask_balls(const CentreOffset& offset, const MovingBody& a, const MovingBody& b,
                      double reach, double tolerance);

// The radius (metres) of a ball about the centre that holds the body, up to rounding.
double outer_reach(const MovingBody& body);

// A point (world) that both inner balls hold, where they overlap.
Vec3d point_in_balls(const CentreOffset& offset, const MovingBody& a, const MovingBody& b);

}  // namespace touchstone
