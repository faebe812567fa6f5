// Blocks of triangles under a pose. Used by concave phases.
#pragma once

#include "algorithms/kernels/triangles/triangle_block.h"

namespace touchstone {

// The block under a pose, in doubles; of floats the same bits as of these as doubles.
template <class Scalar>
void move(const TriangleBlockOf<Scalar>& block, const Pose& pose, TriangleBlock& moved);

}  // namespace touchstone
