// Part of hierarchical-grid: a grid in serpentine (boustrophedon) order, in which boxes are entered
// by their minimum corners. Rows alternate in direction, and so do the cells of a row: consecutive
// boxes are near each other, and adjacent cells of a row are one run.
// Paper: Ericson, "Real-Time Collision Detection", 2005, section 7.2 (the grid of a size class).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "algorithms/core/aabb.h"
#include "algorithms/kernels/grid/cell_space.h"

namespace touchstone {

class SerpentineGrid {
 public:
  using Sides = std::array<double, 3>;
  // The axes along rows, across rows, and across slabs of rows.
  using Axes = std::array<std::size_t, 3>;
  static constexpr double most_cells = 1 << 27;

  // Makes cells as large as `longest`, the longest sides of the boxes, or so large that each of
  // `groups` groups of boxes, spread evenly from low to high, has a cube of cells. Boxes outside of
  // the region are in the outermost cells.
  SerpentineGrid() = default;
  SerpentineGrid(const Axes& axes, const Sides& longest, const Sides& low, const Sides& high,
                 double groups);

  std::uint64_t cells() const { return std::uint64_t{count_[0]} * count_[1] * count_[2]; }
  std::uint64_t cell_of(const Aabb& box) const {
    const std::uint64_t row = row_of(place(box.min[axes_[1]], 1), place(box.min[axes_[2]], 2));
    return cell_in(row, place(box.min[axes_[0]], 0));
  }

  // The cells whose boxes may overlap some bounds: `length` cells of each row.
  struct Window {
    std::array<std::size_t, 3> low, high;
    std::size_t rows() const { return high[1] - low[1] + 1; }
    std::size_t slabs() const { return high[2] - low[2] + 1; }
    std::size_t length() const { return high[0] - low[0] + 1; }
  };
  Window window(const Aabb& bounds) const {
    Window window;
    for (std::size_t k = 0; k < 3; ++k) {
      window.low[k] = place(bounds.min[axes_[k]] - reach_[axes_[k]], k);
      window.high[k] = place(bounds.max[axes_[k]], k);
    }
    return window;
  }
  // The number of the window's first cell in a row.
  std::uint64_t first_cell(const Window& window, std::size_t row, std::size_t slab) const {
    const std::uint64_t number = row_of(row, slab);
    return number * count_[0] + (number % 2 == 0 ? window.low[0] : count_[0] - 1 - window.high[0]);
  }
  std::uint64_t first_cell_of_slab(std::size_t slab) const {
    return std::uint64_t{slab} * count_[1] * count_[0];
  }
  // For pictures: the box of the minimum corners in a cell; box_of_cell explains the region.
  Aabb box_of(std::uint64_t cell, const Aabb& region) const;
  // The longest side of the cells, metres; infinite if there is only one, for boxes in one point.
  double side() const { return 1 / std::ranges::min(space_.inverse_side); }

 private:
  // Cells are shorter along a row than the rows are wide: this is free, since a run spans many
  // cells.
  static constexpr double cells_a_width = 4;

  std::size_t place(double x, std::size_t k) const { return space_.cell(x, axes_[k]); }
  std::uint64_t row_of(std::size_t row, std::size_t slab) const {
    return std::uint64_t{slab} * count_[1] + (slab % 2 == 0 ? row : count_[1] - 1 - row);
  }
  std::uint64_t cell_in(std::uint64_t row, std::size_t cell) const {
    return row * count_[0] + (row % 2 == 0 ? cell : count_[0] - 1 - cell);
  }

  Axes axes_{0, 1, 2};
  CellSpace space_;                            // cells of the boxes' minimum corners
  Sides reach_{};                              // no box is longer; metres
  std::array<std::size_t, 3> count_{1, 1, 1};  // number of cells; indexed as axes_
};

}  // namespace touchstone
