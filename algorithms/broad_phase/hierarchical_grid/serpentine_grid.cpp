// Part of hierarchical-grid: the choice of a grid's cells.
#include "algorithms/broad_phase/hierarchical_grid/serpentine_grid.h"

#include <algorithm>
#include <cmath>

namespace touchstone {

SerpentineGrid::SerpentineGrid(const Axes& axes, const Sides& longest, const Sides& low,
                               const Sides& high, double groups)
    : axes_(axes) {
  Sides extent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach_[axis] = longest[axis] * (1 + 0x1p-16);  // the factor exceeds all rounding errors
    extent[axis] = std::max(high[axis] - low[axis], reach_[axis]);
  }
  // An axis on which the region is thinner than the spacing has one cell; the other axes share the
  // groups.
  std::array<std::size_t, 3> by_extent{0, 1, 2};
  std::ranges::sort(by_extent, {}, [&](std::size_t axis) { return extent[axis]; });
  double spacing = 0;
  for (std::size_t thin = 0; thin < 3; ++thin) {
    double log_spacing = -std::log(groups);
    for (std::size_t i = thin; i < 3; ++i) log_spacing += std::log(extent[by_extent[i]]);
    spacing = std::exp(log_spacing / static_cast<double>(3 - thin));
    if (extent[by_extent[thin]] > spacing) break;
  }
  Sides side;
  for (std::size_t axis = 0; axis < 3; ++axis) side[axis] = std::max(spacing, reach_[axis]);
  side[axes_[0]] /= cells_a_width;
  space_.origin = low;
  while (true) {
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t axis = axes_[k];
      // A grid without extent has one cell.
      const double last = side[axis] > 0 ? std::floor(extent[axis] / side[axis]) : 0;
      space_.inverse_side[axis] = side[axis] > 0 ? 1 / side[axis] : 0;
      space_.last[axis] = static_cast<std::uint32_t>(std::min(last, most_cells));
      count_[k] = space_.last[axis] + std::size_t{1};
      cells *= last + 1;
    }
    if (cells <= most_cells) break;
    for (double& s : side) s *= 2;
  }
}

Aabb SerpentineGrid::box_of(std::uint64_t cell, const Aabb& region) const {
  const std::uint64_t row = cell / count_[0];
  const std::uint64_t slab = row / count_[1];
  const auto unfolded = [](std::uint64_t line, std::uint64_t place, std::size_t count) {
    return static_cast<std::uint32_t>(line % 2 == 0 ? place : count - 1 - place);
  };
  std::array<std::uint32_t, 3> places;
  places[axes_[0]] = unfolded(row, cell % count_[0], count_[0]);
  places[axes_[1]] = unfolded(slab, row % count_[1], count_[1]);
  places[axes_[2]] = static_cast<std::uint32_t>(slab);
  return box_of_cell(space_, places, region);
}

}  // namespace touchstone
