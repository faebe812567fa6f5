// Part of the oracle: two moving features as it sees them, in doubles and on a grid of integers.
// Included by the files of this folder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "algorithms/core/vec.h"
#include "algorithms/oracle/ccd/contact_polynomials.h"

namespace touchstone::oracle::ccd {

// The vertices at time 0 and 1 (finite, any length unit). The first `first_count` are those of the
// first feature: one of a vertex and a face, two of two edges.
struct MovingFeatures {
  int first_count;
  const std::array<Vec3d, 4>& start;
  const std::array<Vec3d, 4>& end;

  // 1 for a vertex of the first feature, -1 for one of the second.
  int side(std::size_t vertex) const { return static_cast<int>(vertex) < first_count ? 1 : -1; }
  const Vec3d& at(int time, std::size_t vertex) const { return (time == 0 ? start : end)[vertex]; }
};

// The grid on which all coordinates are integers: they are multiples of 2^exponent, and below
// 2^(exponent + bits) in magnitude. All coordinates zero: bits is 0.
struct Grid {
  int exponent = 0;
  int bits = 0;
};
Grid grid_of(const MovingFeatures& features);

// The edges as integers on the grid. For `size` limbs, grid.bits <= 64 size - 4 makes room for all
// coefficients of contact_polynomials: an edge has one bit more than a coordinate, an area below
// 2^(2 bits + 6) and a volume below 2^(3 bits + 8).
template <std::size_t size>
MovingEdges<FixedInteger<size>> fixed_edges(const MovingFeatures& features, const Grid& grid);
MovingEdges<Integer> integer_edges(const MovingFeatures& features, const Grid& grid);

// The edges in doubles, in a unit that makes the greatest coordinate less than 1: a power of two.
// Each number has a relative error of at most 2^-53, or an error of 2^-1073.
MovingEdges<double> rounded_edges(const MovingFeatures& features);

// True if one feature is further above the other along an axis than the separation at both times, and
// so at all times, since differences of coordinates are linear in time.
bool are_apart_along_an_axis(const MovingFeatures& features, double separation);

}  // namespace touchstone::oracle::ccd
