// The support cube map: the vertex of a large hull that is furthest in a direction, from few
// vertices and little memory, because at that size a support call waits for memory. Used through
// support_shape.h for hulls of more than 192 vertices.
//
// Directions are divided into cells, squares on the faces of a cube. Vertices near each other share
// a block, and each cell names the blocks of the vertices that may be furthest in one of its
// directions. A call takes one small read and then a few blocks at once. The hull's edges are not
// needed, and nothing depends on where the search starts. The result is the vertex that a test of
// all would find.
// Paper:   Ehmann, Lin, "Accelerated proximity queries between convex polyhedra by multi-level
//          Voronoi marching", IROS 2000 (a table of directions, there as the start of a hill
//          climb).
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/vec.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {

template <class Scalar>
class SupportCubeMap {
 public:
  // The numbers in one vector register of the widest kind.
  static constexpr std::size_t block_size = 64 / sizeof(Scalar);
  struct Block {
    alignas(64) Scalar x[block_size], y[block_size], z[block_size];
  };
  // The blocks of a cell: up to four in ascending order, with the last one repeated. If the last is
  // `listed`, the first two are the place in the lists (low half, high half) of the number of
  // blocks and their indices.
  struct Cell {
    static constexpr std::uint16_t listed = 0xffff;
    std::array<std::uint16_t, 4> blocks;

    bool is_listed() const { return blocks[3] == listed; }
    std::size_t list() const { return blocks[0] | std::size_t{blocks[1]} << 16; }
  };
  // A vertex by its place in the blocks, and its height along the direction.
  struct Found {
    Scalar value;
    std::uint32_t place;
  };

  SupportCubeMap() = default;
  // Upper limit on the number of vertices.
  static constexpr std::size_t most_vertices = block_size * Cell::listed;
  explicit SupportCubeMap(std::span<const Vec3<Scalar>> vertices);

  bool empty() const { return cells_.empty(); }
  // Returns the first vertex, in the order of places, with the greatest rounded direction . v. The
  // direction need not have unit length, but its square must neither overflow nor underflow. For a
  // zero or NaN direction the result is some vertex.
  Found furthest(const Vec3<Scalar>& direction) const;

  Vec3<Scalar> vertex(std::uint32_t place) const {
    const Block& block = blocks_[place / block_size];
    const std::size_t lane = place % block_size;
    return {block.x[lane], block.y[lane], block.z[lane]};
  }
  // The index of the vertex in the constructor's list.
  std::uint32_t number(std::uint32_t place) const { return numbers_[place]; }
  std::size_t held_bytes() const;

  // Prefetches the memory that a support call in this cell reads.
  void prefetch_blocks(const Cell& cell) const {
    if (cell.is_listed()) return;
    for (const std::uint16_t block : cell.blocks) {
      __builtin_prefetch(blocks_[block].x);
      __builtin_prefetch(blocks_[block].y);
      __builtin_prefetch(blocks_[block].z);
    }
  }

  // Access for the loops of support_cube_map.inl.
  const Block* blocks() const { return blocks_.data(); }
  const std::uint16_t* list(const Cell& cell) const { return &lists_[cell.list()]; }
  // The comparisons select the first cell for NaN.
  const Cell& cell_of(Scalar x, Scalar y, Scalar z) const {
    const Scalar sx = x * stretch_[0], sy = y * stretch_[1], sz = z * stretch_[2];
    const Scalar ax = std::abs(sx), ay = std::abs(sy), az = std::abs(sz);
    const std::size_t of_two = ay > ax ? 1 : 0;
    const Scalar most_of_two = ay > ax ? ay : ax;
    const std::size_t axis = az > most_of_two ? 2 : of_two;
    const Scalar most = az > most_of_two ? az : most_of_two;
    const std::array<Scalar, 5> turned = {sx, sy, sz, sx, sy};
    const Scalar scale = half_side_ / most;
    const std::size_t face = 2 * axis + (std::signbit(turned[axis]) ? 1 : 0);
    const std::size_t u = step(turned[axis + 1] * scale), v = step(turned[axis + 2] * scale);
    return cells_[(face << 2 * bits_) + (v << bits_) + u];
  }

 private:
  struct Builder;

  std::size_t step(Scalar from_middle) const {
    const Scalar x = from_middle + half_side_;
    const Scalar above = x > 0 ? x : 0;
    return static_cast<std::size_t>(static_cast<int>(above < last_ ? above : last_));
  }

  std::array<Scalar, 3> stretch_ = {1, 1, 1};  // powers of two that make flat hulls look round
  Scalar half_side_ = 0.5, last_ = 0;          // cells along a face: half their number, the last
  unsigned bits_ = 0;                          // logarithm of the number of cells along a face
  std::vector<Cell> cells_;
  std::vector<Block> blocks_;  // copies of a vertex pad the last block
  std::vector<std::uint16_t> lists_;
  std::vector<std::uint32_t> numbers_;
};

extern template class SupportCubeMap<float>;
extern template class SupportCubeMap<double>;

}  // namespace touchstone
