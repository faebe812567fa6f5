// Bounds on the distances of triangles, eight pairs at once in doubles: which of two blocks' triangles may be
// nearer than a limit, by their boxes and their ends along a way; and gaps along each pair's own way.
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/triangles/triangle_block.h"

namespace touchstone {

// For each triangle of the first block, bits of those of the second that may be nearer than `limit`
// (metres, not negative), as the coordinates stand. `way` is a unit vector up to rounding, or zero.
// NaN counts as near. The first count_a and count_b triangles are compared.
using NearTriangles = std::array<std::uint8_t, TriangleBlock::size>;
NearTriangles near_triangles(const TriangleBlock& a, unsigned count_a, const TriangleBlock& b,
                             unsigned count_b, const Vec3d& way, double limit);

// For each lane, how far b's triangle begins behind the end of a's along about their shortest way
// (metres): mostly their distance, and never more, but for the rounding of the gap, which is less than
// 16 u of the greatest coordinate, u half an epsilon. Negative, or NaN, where nothing is known.
// Paper: Larsen et al., as triangle_distance.h: nearest points of edges, and corners over faces.
void gaps_of_pairs(const TriangleBlock& a, const TriangleBlock& b,
                   std::array<double, TriangleBlock::size>& gap);

}  // namespace touchstone
