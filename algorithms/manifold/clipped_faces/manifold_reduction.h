// The four corners of a convex polygon that are to stand for all of it.
// Paper: Coumans, "Contact generation", GDC 2010 (the deepest point, and then the greatest area).
// Departs: the area is the greatest that there is for four corners one of which is the deepest, and
// not what one corner after the other finds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/manifold/clipped_faces/contact_polygon.h"

namespace touchstone {

// Indices of corners, in their order; of five corners or more, a convex loop. Those whose depths
// are within `rounding` of the greatest are all deepest; at most 16 of those are tried, evenly
// spread. Time O(n^2) for each.
template <class Scalar>
std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<Scalar>>& corners,
                                         Scalar rounding);

extern template std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<float>>&,
                                                         float);
extern template std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<double>>&,
                                                         double);

}  // namespace touchstone
