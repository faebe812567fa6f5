// The vertex of a hull that lies furthest in a direction, by looking at all of them: for each level
// of vector instructions, to be inlined where it is used.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/core/vec.h"
#include "algorithms/kernels/simd/real_lanes.h"

namespace touchstone::hull_scan {

// Sixteen vertices; copies of the first fill up the last block.
template <class Scalar>
struct VertexBlock {
  static constexpr std::size_t size = 16;
  alignas(64) Scalar x[size], y[size], z[size];

  Vec3<Scalar> vertex(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// `vertex(k)` for k < count, which is at least 1.
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

inline constexpr std::size_t most_blocks = 16;  // that are looked at together

// At each level `furthest_at(blocks, x, y, z)` is the index of the vertex with the greatest d.v;
// of several the first: the same at every level. NaN is nobody's greatest: then it is vertex 0.
#define TOUCHSTONE_LANES real_lanes
#define TOUCHSTONE_LOOPS "algorithms/kernels/minkowski/hull_scan.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

// At the level in use: the vertex, and the value.
template <class Scalar>
std::uint32_t furthest(std::span<const VertexBlock<Scalar>> blocks, const Vec3<Scalar>& direction);
template <class Scalar>
Scalar greatest(std::span<const VertexBlock<Scalar>> blocks, const Vec3<Scalar>& direction);

extern template std::uint32_t furthest(std::span<const VertexBlock<float>>, const Vec3<float>&);
extern template std::uint32_t furthest(std::span<const VertexBlock<double>>, const Vec3<double>&);
extern template float greatest(std::span<const VertexBlock<float>>, const Vec3<float>&);
extern template double greatest(std::span<const VertexBlock<double>>, const Vec3<double>&);

}  // namespace touchstone::hull_scan
