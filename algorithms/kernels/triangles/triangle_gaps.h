// Which of two blocks' triangles may be nearer than a limit, by their boxes and their ends along a way,
// eight pairs at once in doubles.
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

}  // namespace touchstone
