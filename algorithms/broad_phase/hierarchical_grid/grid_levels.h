// Part of hierarchical-grid: bodies sorted by the cells of grids, with one grid for each size class
// and one for each dense cell of another, such as a dense cluster in a wide world.
// Papers: Ericson, "Real-Time Collision Detection", 2005, section 7.2 (a grid for each size class);
//         Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems", thesis, Berkeley 1996.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/broad_phase/hierarchical_grid/magnitude_histogram.h"
#include "algorithms/broad_phase/hierarchical_grid/serpentine_grid.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

// The levels; they keep their memory.
class GridLevels {
 public:
  struct Level {
    SerpentineGrid grid;
    IndexRange boxes{0, 0};
    Aabb bounds = everywhere;      // bounds of a dense cell's boxes; unlimited for a size class
    std::uint64_t first_cell = 0;  // number of the grid's first cell among the cells of all levels
    std::size_t first_entry = 0;   // place in the index
    int index_shift = 0;
  };

  // `ids` lists the boxes that are not empty. A cube of cells holds about `bodies_a_cube` where the
  // density is the average.
  void sort(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
            double bodies_a_cube);

  // The levels, by size; those of dense cells follow their own. The boxes are in the same order.
  std::span<const Level> levels() const { return levels_; }
  std::size_t size() const { return items_.size(); }
  std::uint32_t id(std::size_t place) const {
    return static_cast<std::uint32_t>(items_[place] & ((std::uint64_t{1} << id_bits_) - 1));
  }
  // The number of the box's cell in its level's grid.
  std::uint64_t cell(const Level& level, std::size_t place) const {
    return cell(place) - level.first_cell;
  }
  // The first box of the level in this cell or a later one.
  std::size_t find(const Level& level, std::uint64_t cell) const {
    const std::uint64_t entry = level.first_entry + (cell >> level.index_shift);
    if (level.index_shift == 0) return index_[entry];
    const auto begin = items_.begin();
    return static_cast<std::size_t>(std::lower_bound(begin + index_[entry],
                                                     begin + index_[entry + 1],
                                                     (level.first_cell + cell) << id_bits_) -
                                    begin);
  }

  std::size_t held_bytes() const;

 private:
  static constexpr std::size_t block_size = 8192;
  static constexpr std::size_t most_classes = 16;
  // A class with fewer members joins the next larger one.
  static constexpr std::size_t least_members = 64;
  // A cell with this many boxes is dense; it is split if its own grid has at least `least_cells`.
  static constexpr std::size_t least_dense = 256;
  static constexpr std::uint64_t least_cells = 64;
  static constexpr Aabb everywhere{
      {std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
       std::numeric_limits<float>::lowest()},
      {std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
       std::numeric_limits<float>::max()}};

  std::uint64_t cell(std::size_t place) const { return items_[place] >> id_bits_; }
  std::uint64_t item(const Level& level, const Aabb& box, std::uint32_t id) const {
    return (level.first_cell + level.grid.cell_of(box)) << id_bits_ | id;
  }
  void take_cells(Level& level) {
    level.first_cell = cells_;
    cells_ += level.grid.cells();
  }
  void make_levels(Executor& executor, std::span<const Aabb> boxes,
                   std::span<const std::uint32_t> ids);
  void sort_items(Executor& executor, std::span<const Aabb> boxes,
                  std::span<const std::uint32_t> ids);
  void split_dense_cells(Executor& executor, std::span<const Aabb> boxes, std::size_t level);
  void list_dense_cells(std::span<const Aabb> boxes, IndexRange range);
  Level level_of_dense_cell(std::span<const Aabb> boxes, IndexRange dense_cell) const;
  void sort_dense_cell(Executor& executor, std::span<const Aabb> boxes, const Level& level);
  void index_cells(Executor& executor);

  double bodies_a_cube_ = 1;
  std::vector<MagnitudeHistogram> measures_;
  SerpentineGrid::Axes axes_{0, 1, 2};
  std::array<std::uint8_t, box_magnitudes> level_of_{};
  std::vector<Level> levels_;
  std::uint64_t cells_ = 0;           // number of cells of all levels
  std::vector<std::uint64_t> items_;  // cell above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<Level> dense_cells_;                  // levels of one level's dense cells
  std::vector<std::uint64_t> before_, dense_cell_;  // items of the level, and of one dense cell
  RadixSort<std::uint64_t> dense_sort_;
  std::vector<std::uint32_t> index_;  // the first box in each 2^index_shift cells, or after them
};

}  // namespace touchstone
