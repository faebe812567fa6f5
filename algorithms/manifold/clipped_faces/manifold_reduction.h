// Part of clipped-faces: manifold reduction, which picks four corners to represent a convex contact
// polygon.
// Paper:   Coumans, "Contact generation", GDC 2010 (the deepest point, then the greatest area).
// Departs: the area is the greatest over all quadruples that contain a deepest corner; the paper
//          adds one corner after the other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/manifold/clipped_faces/contact_polygon.h"

namespace touchstone {

// Returns four indices in ascending order. `corners` is a convex loop of at least five. Corners
// whose depths are within `rounding` of the greatest count as deepest; at most 16 of them are
// tried, spread evenly. Each takes O(n^2) time.
template <class Scalar>
std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<Scalar>>& corners,
                                         Scalar rounding);

extern template std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<float>>&,
                                                         float);
extern template std::array<std::uint32_t, 4> choose_four(const std::vector<PolygonCorner<double>>&,
                                                         double);

}  // namespace touchstone
