// Which of two blocks' triangles share a point, by fifteen signs of volumes in doubles, a pair a
// lane. What rounding leaves open is said, for a test in integers.
// Papers: Devillers, Guigue, "Faster triangle-triangle intersection tests", INRIA RR-4488, 2002
//         (signs of volumes decide); Shewchuk, "Adaptive precision floating-point arithmetic and
//         fast robust geometric predicates", 1997 (a static bound before exact arithmetic).
//
// The signs are those of the six corners about the other triangle's plane, and of the nine volumes
// of an edge of one and an edge of the other. An edge whose ends lie on both sides of a plane
// pierces the triangle if its three volumes have one sign; the line of an edge misses it if two of
// them differ. The triangles share a point if and only if an edge of one meets the other. Touches
// and degenerate triangles have a zero among the signs that would decide, so they stay open.
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/triangles/triangle_block.h"

namespace touchstone {

// For each triangle of the first block, bits of those of the second.
struct BlockSigns {
  std::array<std::uint8_t, TriangleBlock::size> yes, open;  // they share a point; rounding hides it
};

// `error` bounds by how much any coordinate of the blocks is off (metres). The triangles whose
// bits are set in lanes_a and lanes_b are compared. Returns true if any bit is set.
template <class Scalar>
bool compare(const TriangleBlockOf<Scalar>& a, unsigned lanes_a, const TriangleBlock& b,
             unsigned lanes_b, double error, BlockSigns& signs);

}  // namespace touchstone
