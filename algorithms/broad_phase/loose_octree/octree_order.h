// Bodies in the order of a linear octree: each in the cell that holds its centre, at the level of
// its size; a cell's own bodies first, then those of its eight parts.
// Papers: Gargantini, "An Effective Way to Represent Quadtrees", CACM 1982 (sorted codes instead of
//         nodes); Ulrich, "Loose Octrees", Game Programming Gems, 2000 (the size gives the level).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/kernels/grid/cell_space.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

// Keeps its memory.
class OctreeOrder {
 public:
  // Levels below the root, at most: 3 bits of code each, and some for a body's own depth, which is
  // this where it is in a finest cell, however many levels there are.
  static constexpr int most_levels = 9;

  // `ids`: of boxes that are not empty. The octree's root is the region where most of them are:
  // those outside are in the outermost cells. Has so many levels that a finest cell has a body or
  // two, where they are spread evenly.
  void sort(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

  // Gives those of a range, who have one key, an octree of their own, over just the region where
  // they are. Where they were not in a finest cell their sizes are left out of account, since it
  // is these that keep them together: all come into finest cells. False where all have one centre:
  // then nothing is done.
  bool refine(Executor& executor, std::span<const Aabb> boxes, std::size_t first, std::size_t last);

  std::size_t size() const { return items_.size(); }
  std::uint32_t id(std::size_t place) const {
    return static_cast<std::uint32_t>(items_[place] & ((std::uint64_t{1} << id_bits_) - 1));
  }
  // The Morton code of the cell, in finest cells, above; the cell's depth below.
  std::uint32_t key(std::size_t place) const {
    return static_cast<std::uint32_t>(items_[place] >> id_bits_);
  }
  // How many of the levels' digits in `key` two keys, of one octree, have in common.
  static int common_levels(std::uint32_t a, std::uint32_t b);
  static int depth(std::uint32_t key) { return static_cast<int>(key & ((1u << depth_bits) - 1)); }
  // The eighth of the cell at this depth in which the key is.
  static std::uint32_t octant(std::uint32_t key, int depth) {
    return key >> (depth_bits + 3 * (most_levels - 1 - depth)) & 7;
  }

  std::size_t held_bytes() const;

 private:
  static constexpr int depth_bits = 4;

  struct Cells {
    CellSpace space;  // the finest
    int levels;
  };
  static Cells make_cells(const BoxSample& sample, double bodies);
  void sort_items(Executor& executor, std::vector<std::uint64_t>& items, int levels,
                  RadixSort<std::uint64_t>& radix_sort) const;
  static std::uint32_t key_of(const Aabb& box, const Cells& cells, bool by_size);

  std::vector<std::uint64_t> items_;  // key above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<std::uint64_t> crowd_;  // of a range that is sorted anew
  RadixSort<std::uint64_t> crowd_sort_;
};

}  // namespace touchstone
