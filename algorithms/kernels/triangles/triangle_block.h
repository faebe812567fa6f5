// Eight triangles side by side, one a lane. Used by what compares the triangles of two leaves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/pose.h"

namespace touchstone {

template <class Scalar>
struct alignas(8 * sizeof(Scalar)) TriangleBlockOf {
  static constexpr std::size_t size = 8;
  // The corner k of lane i has the coordinates at[3 k + axis][i] (metres).
  std::array<std::array<Scalar, size>, 9> at;

  Vec3d corner(std::size_t lane, std::size_t k) const {
    return {at[3 * k][lane], at[3 * k + 1][lane], at[3 * k + 2][lane]};
  }
};
using TriangleBlock = TriangleBlockOf<double>;
// Half as much memory, for meshes whose coordinates are floats.
using FloatTriangleBlock = TriangleBlockOf<float>;

// Blocks of the mesh's triangles in the given order. Lanes behind the last triangle repeat it.
template <class Scalar>
std::vector<TriangleBlockOf<Scalar>> triangle_blocks(const TriangleMesh& mesh,
                                                     std::span<const std::uint32_t> order) {
  constexpr std::size_t size = TriangleBlock::size;
  std::vector<TriangleBlockOf<Scalar>> blocks((order.size() + size - 1) / size);
  for (std::size_t place = 0; place < blocks.size() * size; ++place) {
    const auto& corners = mesh.triangles[order[place < order.size() ? place : order.size() - 1]];
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        blocks[place / size].at[3 * k + axis][place % size] =
            static_cast<Scalar>(mesh.vertices[corners[k]][static_cast<int>(axis)]);
      }
    }
  }
  return blocks;
}

}  // namespace touchstone
