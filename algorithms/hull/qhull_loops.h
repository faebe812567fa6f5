// Part of algorithms/hull, used by convex_hull.cpp alone: the facets that Qhull finds, unchecked.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

// Indices of a face's vertices, in the order of its edges.
using Loop = std::vector<std::uint32_t>;

// Runs Qhull and returns the loop of each facet of the points' hull, in either direction. Facets
// merge if they differ by less than `merge_distance`. Returns an empty list if Qhull fails, or if
// the edges of a facet do not form one loop.
std::vector<Loop> qhull_loops(std::vector<Vec3d>& points, double merge_distance);

}  // namespace touchstone
