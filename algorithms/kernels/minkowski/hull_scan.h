// The vertex of a hull that is furthest in a direction, found by testing all vertices. Used by
// every narrow phase with hulls, and inlined into loops at each level of vector instructions.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/core/vec.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone::hull_scan {

// Sixteen vertices. Copies of the first vertex pad the last block.
template <class Scalar>
struct VertexBlock {
  static constexpr std::size_t size = 16;
  alignas(64) Scalar x[size], y[size], z[size];

  Vec3<Scalar> vertex(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// Makes blocks of `vertex(k)` for k < count, with count >= 1.
template <class Scalar, class Vertex>
std::vector<VertexBlock<Scalar>> blocks_of(std::size_t count, const Vertex& vertex) {
  constexpr std::size_t size = VertexBlock<Scalar>::size;
  std::vector<VertexBlock<Scalar>> blocks((count + size - 1) / size);
  for (std::size_t k = 0; k < blocks.size() * size; ++k) {
    const Vec3<Scalar> v = vertex(k < count ? k : 0);
    blocks[k / size].x[k % size] = v.x();
    blocks[k / size].y[k % size] = v.y();
    blocks[k / size].z[k % size] = v.z();
  }
  return blocks;
}

template <class Scalar>
struct Found {
  Scalar value;
  std::uint32_t index;
};

inline constexpr std::size_t most_blocks = 16;  // blocks that are tested together

// The vertices of a hull. In double those of some are there as floats too: of hulls for which
// `is_scanned_in_floats` holds, and whose coordinates are at most 1 in magnitude.
template <class Scalar>
struct ScannedHull {
  std::span<const VertexBlock<Scalar>> blocks;
  const VertexBlock<float>* rough = nullptr;
};

// Whether a scan in floats takes less time, or as much, for so many blocks in double.
constexpr bool is_scanned_in_floats(std::size_t blocks) {
  return blocks > 4 && blocks <= most_blocks;
}

// The function `furthest_at(blocks, x, y, z)` of each level returns the index of the vertex with
// the greatest d.v, and the first if there are several. The result is equal at every level. NaN
// is never the greatest, but a product that is infinite may be lost beside it; if all are NaN the
// index is 0.
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/minkowski/hull_scan.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

// The vertex and the value, computed at the active level.
template <class Scalar>
std::uint32_t furthest(const ScannedHull<Scalar>& hull, const Vec3<Scalar>& direction);
template <class Scalar>
Scalar greatest(std::span<const VertexBlock<Scalar>> blocks, const Vec3<Scalar>& direction);

extern template std::uint32_t furthest(const ScannedHull<float>&, const Vec3<float>&);
extern template std::uint32_t furthest(const ScannedHull<double>&, const Vec3<double>&);
extern template float greatest(std::span<const VertexBlock<float>>, const Vec3<float>&);
extern template double greatest(std::span<const VertexBlock<double>>, const Vec3<double>&);

}  // namespace touchstone::hull_scan
