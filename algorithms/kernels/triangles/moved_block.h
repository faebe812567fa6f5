// Blocks of triangles under a pose, and blocks of floats as doubles. Used by concave phases.
#pragma once

#include "algorithms/kernels/triangles/triangle_block.h"

namespace touchstone {

// The block under a pose, in doubles.
void move(const TriangleBlock& block, const Pose& pose, TriangleBlock& moved);
// The same bits as of the widened block.
void move(const FloatTriangleBlock& block, const Pose& pose, TriangleBlock& moved);

void widen(const FloatTriangleBlock& block, TriangleBlock& wide);

}  // namespace touchstone
