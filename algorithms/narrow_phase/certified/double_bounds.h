// Part of certified: bounds on the signed distance of two bounded bodies from the numbers of GJK and
// EPA in doubles. Includes core, kernels and this folder.
//
// They are proven by the bound on the rounding of a pair's support points (proven_rounding.h), and
// 6e-14 of the pair's unit wide.
#pragma once

#include "algorithms/kernels/epa/epa_hull.h"
#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/narrow_phase/certified/support_bounds.h"

namespace touchstone {

// Nothing is proven of cores that may share a point.
DistanceBounds between_in_doubles(const SupportPair<double>& pair,
                                  const GjkDistanceResult<double>& found);

// Bounds the signed distance of two polytopes without radius that overlap. `surface` is closed and
// its corners are support points of this pair. `depth` is the height of the pair's support along
// some unit vector, in the pair's unit. Nothing is proven if a face may be behind the origin.
DistanceBounds inside_in_doubles(const SupportPair<double>& pair, const EpaHull<double>& surface,
                                 double depth);

// The difference of the bounds on a distance or depth at which an iteration may stop (in the pair's
// unit), if these functions are to prove an interval of `widest` metres. It may be negative.
double tolerance_in_doubles(const SupportPair<double>& pair, double widest);

}  // namespace touchstone
