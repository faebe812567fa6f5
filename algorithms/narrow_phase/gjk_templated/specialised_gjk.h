// Part of gjk-templated: GJK's loops compiled for two given cores, so that no support call switches
// on them. Includes kernels/gjk.
//
// There is one version for each pair of the seven bounded cores, whose support maps are different
// code: point (sphere), segment (capsule), box, cylinder, cone, ellipsoid, hull. The search in a
// hull depends on that hull and is still selected at run time. All versions start cold.
#pragma once

#include <array>

#include "algorithms/kernels/gjk/gjk_distance.h"

namespace touchstone {

inline constexpr std::size_t specialised_cores = static_cast<std::size_t>(SupportCore::halfspace);

// table[a][b] for a <= b in the order of SupportCore: versions specialised for the two core types,
// with results bit for bit equal to the generic ones. Entries with a > b are generic.
template <class Scalar>
using CoreTable =
    std::array<std::array<CoreFunctions<Scalar>, specialised_cores>, specialised_cores>;

template <class Scalar>
CoreTable<Scalar> specialised_functions();

extern template CoreTable<float> specialised_functions();
extern template CoreTable<double> specialised_functions();

}  // namespace touchstone
