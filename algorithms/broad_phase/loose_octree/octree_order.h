// Part of loose-octree: bodies in the order of a linear octree. Each lies in the cell that contains
// its centre, at the level of its size; a cell's own bodies precede those of its octants.
// Papers: Gargantini, "An Effective Way to Represent Quadtrees", CACM 1982 (sorted codes instead of
//         nodes); Ulrich, "Loose Octrees", Game Programming Gems, 2000 (the size gives the level).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/kernels/grid/cell_space.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

// The sorted bodies; the class keeps its memory.
class OctreeOrder {
 public:
  // The greatest number of levels below the root: a key has 3 bits for each level, and 4 for the
  // depth of the body's cell. Depths count from the root, but a cell of the finest level in use has
  // depth `most_levels`, even if fewer levels are in use.
  static constexpr int most_levels = 9;

  // Sorts the bodies. `ids` lists the boxes that are not empty. The root is the region that holds
  // most of them; boxes outside are in the outermost cells. The number of levels is such that a
  // finest cell holds one or two bodies if they are spread evenly.
  void sort(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

  // Subdivides a range of boxes that share a key with an octree of its own over their bounds. If
  // the key is not at the finest level, box size is ignored, because size is what put them all
  // there. Returns false, and changes nothing, if all centres coincide.
  bool refine(Executor& executor, std::span<const Aabb> boxes, std::size_t first, std::size_t last);

  std::size_t size() const { return items_.size(); }
  std::uint32_t id(std::size_t place) const {
    return static_cast<std::uint32_t>(items_[place] & ((std::uint64_t{1} << id_bits_) - 1));
  }
  // The key: the Morton code of the cell, in finest cells, above the cell's depth.
  std::uint32_t key(std::size_t place) const {
    return static_cast<std::uint32_t>(items_[place] >> id_bits_);
  }
  // The number of leading levels in which two keys of one octree agree.
  static int common_levels(std::uint32_t a, std::uint32_t b);
  static int depth(std::uint32_t key) { return static_cast<int>(key & ((1u << depth_bits) - 1)); }
  // The octant, of a cell at this depth, that contains the key.
  static std::uint32_t octant(std::uint32_t key, int depth) {
    return key >> (depth_bits + 3 * (most_levels - 1 - depth)) & 7;
  }

  std::size_t held_bytes() const;

 private:
  static constexpr int depth_bits = 4;

  struct Cells {
    CellSpace space;  // cells of the finest level
    int levels;
  };
  static Cells make_cells(const BoxSample& sample, double bodies);
  void sort_items(Executor& executor, std::vector<std::uint64_t>& items, int levels,
                  RadixSort<std::uint64_t>& radix_sort) const;
  static std::uint32_t key_of(const Aabb& box, const Cells& cells, bool by_size);

  std::vector<std::uint64_t> items_;  // key above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<std::uint64_t> dense_cell_;  // items of a range that is refined
  RadixSort<std::uint64_t> dense_sort_;
};

}  // namespace touchstone
