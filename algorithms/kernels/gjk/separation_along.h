// How far two bodies' cores are apart along a direction: what a plane between them proves, without
// the points that support it.
#pragma once

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// The least direction . y over the core of b, less the greatest direction . x over that of a, for a
// unit vector, in the pair's unit: where positive, a lower bound of the cores' distance. As exact
// as the planes of support points are. Counted as a support call.
template <class Scalar>
Scalar gap_along(SupportPair<Scalar>& pair, const Vec3<Scalar>& direction);

extern template float gap_along(SupportPair<float>&, const Vec3<float>&);
extern template double gap_along(SupportPair<double>&, const Vec3<double>&);

}  // namespace touchstone
