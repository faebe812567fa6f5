// Part of hierarchical-grid: size classes, the sort by cell, the split of dense cells, the index.
#include "algorithms/broad_phase/hierarchical_grid/grid_levels.h"

#include <bit>
#include <functional>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/grid/cell_space.h"
#include "algorithms/kernels/grid/dense_cells.h"

namespace touchstone {

void GridLevels::sort(Executor& executor, std::span<const Aabb> boxes,
                      std::span<const std::uint32_t> ids, double bodies_a_cube) {
  bodies_a_cube_ = bodies_a_cube;
  make_levels(executor, boxes, ids);
  sort_items(executor, boxes, ids);
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    split_dense_cells(executor, boxes, level);
  }
  index_cells(executor);
}

void GridLevels::make_levels(Executor& executor, std::span<const Aabb> boxes,
                             std::span<const std::uint32_t> ids) {
  levels_.clear();
  cells_ = 0;
  if (ids.empty()) return;
  const BoxSample sample = sample_boxes(boxes, ids);
  const MagnitudeHistogram measures = magnitude_histogram(executor, boxes, ids, measures_);
  const double clustering = clustering_of(boxes, ids, sample);
  axes_ = {0, 1, 2};
  const auto cells_wide = [&](std::size_t axis) {
    return (sample.high[axis] - sample.low[axis]) / sample.side[axis];
  };
  std::ranges::sort(axes_, [&](std::size_t a, std::size_t b) {
    const double of_a = cells_wide(a);
    const double of_b = cells_wide(b);
    return of_a > of_b || (of_a == of_b && a < b);
  });
  // Classes are formed from the smallest magnitude up. A class closes when it has enough members;
  // the largest boxes get a class of their own, however few they are.
  MagnitudeBin open;
  std::size_t place = 0;
  for (std::size_t i = 0; i < box_magnitudes; ++i) {
    level_of_[i] = static_cast<std::uint8_t>(levels_.size());
    open.add(measures[i]);
    const bool last = i + 1 == box_magnitudes;
    if (open.members == 0) continue;
    if (!last && (open.members < least_members || levels_.size() + 1 == most_classes)) continue;
    const double groups =
        std::max(1.0, static_cast<double>(open.members) * clustering / bodies_a_cube_);
    Level level{.grid = {axes_, open.side, sample.low, sample.high, groups},
                .boxes = {place, place + open.members}};
    take_cells(level);
    levels_.push_back(level);
    place += open.members;
    open = {};
  }
}

void GridLevels::sort_items(Executor& executor, std::span<const Aabb> boxes,
                            std::span<const std::uint32_t> ids) {
  items_.resize(ids.size());
  id_bits_ = static_cast<int>(std::bit_width(boxes.size()));
  for_each_block(executor, ids.size(), block_size,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const Aabb& box = boxes[ids[i]];
                     items_[i] = item(levels_[level_of_[magnitude(box)]], box, ids[i]);
                   }
                 });
  radix_sort_(executor, items_, static_cast<int>(std::bit_width(cells_)),
              [bits = id_bits_](std::uint64_t item) { return item >> bits; });
}

// Makes levels of a level's dense cells and inserts them after it; these may have dense cells too.
void GridLevels::split_dense_cells(Executor& executor, std::span<const Aabb> boxes,
                                   std::size_t level) {
  list_dense_cells(boxes, levels_[level].boxes);
  if (dense_cells_.empty()) return;
  IndexRange& own = levels_[level].boxes;
  const auto begin = items_.begin();
  before_.assign(begin + own.first, begin + own.last);
  const auto before = [&](std::size_t place) { return before_.begin() + (place - own.first); };
  std::size_t next = own.first;
  auto end = begin + own.first;
  for (const Level& dense_cell : dense_cells_) {
    end = std::copy(before(next), before(dense_cell.boxes.first), end);
    next = dense_cell.boxes.last;
  }
  end = std::copy(before(next), before_.end(), end);
  const auto kept = static_cast<std::size_t>(end - begin);
  for (Level& dense_cell : dense_cells_) {
    dense_cell_.assign(before(dense_cell.boxes.first), before(dense_cell.boxes.last));
    dense_cell.boxes = {static_cast<std::size_t>(end - begin), 0};
    dense_cell.boxes.last = dense_cell.boxes.first + dense_cell_.size();
    take_cells(dense_cell);
    sort_dense_cell(executor, boxes, dense_cell);
    end = std::copy(dense_cell_.begin(), dense_cell_.end(), end);
  }
  own.last = kept;
  levels_.insert(levels_.begin() + level + 1, dense_cells_.begin(), dense_cells_.end());
}

void GridLevels::list_dense_cells(std::span<const Aabb> boxes, IndexRange range) {
  dense_cells_.clear();
  visit_dense_cells(
      range, least_dense, [&](std::size_t i) { return cell(i); },
      [&](IndexRange dense_cell) {
        const Level level = level_of_dense_cell(boxes, dense_cell);
        if (level.grid.cells() >= least_cells) dense_cells_.push_back(level);
      });
}

GridLevels::Level GridLevels::level_of_dense_cell(std::span<const Aabb> boxes,
                                                  IndexRange dense_cell) const {
  MagnitudeBin measure;
  Aabb bounds = Aabb::empty();
  std::array<double, 3> low, high;
  high.fill(std::numeric_limits<double>::lowest());
  for (std::size_t i = dense_cell.first; i < dense_cell.last; ++i) {
    const Aabb& box = boxes[id(i)];
    measure.add(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::min(bounds.min[axis], box.min[axis]);
      bounds.max[axis] = std::max(bounds.max[axis], box.max[axis]);
      low[axis] = bounds.min[axis];
      high[axis] = std::max(high[axis], double{box.min[axis]});
    }
  }
  const double groups = static_cast<double>(measure.members) / bodies_a_cube_;
  return {.grid = {axes_, measure.side, low, high, groups}, .boxes = dense_cell, .bounds = bounds};
}

void GridLevels::sort_dense_cell(Executor& executor, std::span<const Aabb> boxes,
                                 const Level& level) {
  const std::uint64_t ids = (std::uint64_t{1} << id_bits_) - 1;
  for (std::uint64_t& own : dense_cell_) {
    const auto body = static_cast<std::uint32_t>(own & ids);
    own = item(level, boxes[body], body);
  }
  if (dense_cell_.size() < 2048) {
    std::ranges::sort(dense_cell_);
    return;
  }
  dense_sort_(executor, dense_cell_, static_cast<int>(std::bit_width(level.grid.cells())),
              [bits = id_bits_, first = level.first_cell](std::uint64_t item) {
                return (item >> bits) - first;
              });
}

// Makes the index, of at most four entries a body.
void GridLevels::index_cells(Executor& executor) {
  std::size_t entries = 0;
  for (Level& level : levels_) {
    const std::size_t members = level.boxes.last - level.boxes.first;
    level.index_shift = 0;
    while (level.grid.cells() >> level.index_shift > 4 * members + 4) ++level.index_shift;
    level.first_entry = entries;
    entries += (level.grid.cells() >> level.index_shift) + 2;
  }
  index_.resize(entries);
  for (const Level& level : levels_) {
    const std::size_t end = level.first_entry + (level.grid.cells() >> level.index_shift) + 2;
    const auto entry_of = [&](std::size_t i) {
      return level.first_entry + ((cell(i) - level.first_cell) >> level.index_shift);
    };
    const std::size_t begin = level.boxes.first;
    for_each_block(executor, level.boxes.last - begin, block_size,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     std::size_t entry =
                         first == 0 ? level.first_entry : entry_of(begin + first - 1) + 1;
                     for (std::size_t i = begin + first; i < begin + last; ++i) {
                       for (const std::size_t own = entry_of(i); entry <= own; ++entry) {
                         index_[entry] = static_cast<std::uint32_t>(i);
                       }
                     }
                   });
    const std::size_t behind =
        begin == level.boxes.last ? level.first_entry : entry_of(level.boxes.last - 1) + 1;
    std::fill(index_.begin() + static_cast<std::ptrdiff_t>(behind),
              index_.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<std::uint32_t>(level.boxes.last));
  }
}

std::size_t GridLevels::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(measures_, levels_, items_, radix_sort_,
                                                 dense_cells_, before_, dense_cell_, dense_sort_,
                                                 index_));
}

}  // namespace touchstone
