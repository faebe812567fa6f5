// Four moving vertices relative to the first, scaled for proofs in doubles.
#pragma once

#include <array>

#include "algorithms/core/vec.h"

namespace touchstone {

// The vertices 1, 2 and 3 less the vertex 0: x, y, z of each at time 0, then at time 1. The unit is a
// power of two, so that scaling rounds nothing; all coordinates are below 1, and one is at least
// 1/4 unless the vertices are nearer than 2^-1020 to each other. Each is off by a relative 2^-53 or by
// 2^-1074.
struct ScaledEdges {
  std::array<double, 18> at;
  double scale;  // lengths in metres times this are in the unit
};

// A length below which the arithmetic on scaled edges is not to be trusted: 64 roundings. Each
// algorithm says why it suffices.
inline constexpr double scaled_error = 64 * 0x1p-53;

// The scale of edges whose greatest magnitude of a coordinate is this; 0 if they overflow.
double scale_of_edges(double reach);

// Returns false if the edges overflow.
bool scale_edges(const std::array<Vec3d, 4>& start, const std::array<Vec3d, 4>& end,
                 ScaledEdges& edges);

}  // namespace touchstone
