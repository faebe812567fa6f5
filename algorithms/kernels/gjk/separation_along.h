// The gap between two bodies' cores along a direction: the bound that a plane proves, without its
// support points. Used by gjk_distance.inl for warm starts, and by advancement.cpp.
#pragma once

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// Returns the least direction . y over the core of b minus the greatest direction . x over that of
// a, for a unit vector, in the pair's unit. If positive it is a lower bound on the cores' distance,
// as exact as the planes of support points. Counts as a support call.
template <class Scalar>
Scalar separation_along(SupportPair<Scalar>& pair, const Vec3<Scalar>& direction);

extern template float separation_along(SupportPair<float>&, const Vec3<float>&);
extern template double separation_along(SupportPair<double>&, const Vec3<double>&);

}  // namespace touchstone
