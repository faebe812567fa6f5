// GJK's loop and its quick walk compiled for two cores that are known: no support call asks which
// they are.
//
// There is one for each two of the seven bounded cores, whose support maps are seven different
// pieces of code: point (sphere), segment (capsule), box, cylinder, cone, ellipsoid, hull. How a
// hull is searched is a matter of that hull, and still asked. They start cold.
#pragma once

#include <array>

#include "algorithms/kernels/gjk/gjk_distance.h"

namespace touchstone {

inline constexpr std::size_t known_cores = static_cast<std::size_t>(SupportCore::halfspace);

// What `approach` of gjk_approach.h and `walk` of simplex_walk.h find, to the last bit, by a's core
// and b's, of which a's comes first in the order of SupportCore, or is the same. Those of others
// are for any cores.
template <class Scalar>
using CoreTable = std::array<std::array<CoreWalks<Scalar>, known_cores>, known_cores>;

template <class Scalar>
CoreTable<Scalar> walks_of_known_cores();

extern template CoreTable<float> walks_of_known_cores();
extern template CoreTable<double> walks_of_known_cores();

}  // namespace touchstone
