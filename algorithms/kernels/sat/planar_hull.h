// The convex hull of points that lie on a plane or a line. Used by polytope.cpp and clipped-faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

struct PlanarHull {
  // Indices of points: the corners of the convex hull, anticlockwise about the normal, or the two
  // ends of a segment.
  std::vector<std::uint32_t> loop;
  Vec3<long double> normal = Vec3<long double>::Zero();  // unit; zero for points on a line
};

std::size_t farthest_from(std::span<const Vec3<long double>> points, const Vec3<long double>& from);

// Requires at least one point.
PlanarHull planar_hull(std::span<const Vec3<long double>> points);

}  // namespace touchstone
