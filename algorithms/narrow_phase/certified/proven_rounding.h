// Part of certified: how far rounding moves a support point of a pair, proven. Includes kernels.
#pragma once

#include <limits>

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// The bound holds for poses with any matrix. Let u be half of epsilon, M a core's matrix and v a
// point of the core, both as stored; (..)_i is a component, |..| applies to each. The unit is above
// the offset and the reach of both bodies, so (|M| |v|)_i <= sqrt(3), and its sum with the
// components of a unit vector n is at most 3. For a support point w = p - q and any direction n:
//                                              each component      along n
//   stored v (hulls: centre subtracted)         sqrt(3) u           3 u   a body
//   ... or computed v of a curved core           6 sqrt(3) u        in `furthest`
//   product M v                                 3 sqrt(3) u         9 u   a body
//   offset of the centres                       32 u               55 u
//   q = M v + offset, and p - q                 2.8 u, 4.5 u        5 u, 8 u
//   furthest: n turned (9 u, and again for the furthest itself), each product with a vertex (9 u)
//     or curved support (18 u); a cone's choice of tip or rim (27 u)     36 u to 63 u a body
//   the product n . w, of |w| <= 8                                 23 u
//   the length of n and the division by it                         31 u
//   both radii and their sum                                        4 u
// Only hulls have a centre off their origin; otherwise the offset is accurate to u. So no pair of
// kinds exceeds 107 u for the length by which w is off a point of the difference, and 248 u for
// its plane as a bound of the difference. Underflow is at most 2^-1074 of the unit. Sums of
// weighted points, with weights >= 0, and their length are off by 90 u more than w.
inline constexpr double proven_rounding = 128 * std::numeric_limits<double>::epsilon();

// The condition of the proof: lengths are below the unit. (`power_of_two_above` ends there.)
inline constexpr double greatest_unit = 0x1p959;
inline bool is_in_range(const SupportPair<double>& pair) { return pair.unit() < greatest_unit; }

}  // namespace touchstone
