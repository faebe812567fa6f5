// Uniform grid: enter each box in every cell that it touches, test the boxes of each cell.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 7.1; the home-cell rule is the
//          reference-point method of Dittrich, Seeger, "Data Redundancy and Duplicate Detection in
//          Spatial Join Processing", ICDE 2000.
// Steps:   1. Sample the boxes; choose cells of twice the size that nine boxes in ten do not
//             exceed.
//          2. Set boxes aside as large if they touch more than 64 cells.
//          3. Write an entry for each cell of each other box, and radix-sort the entries by cell.
//          4. Sort cells of 512 entries and more by their boxes' minima on the axis that separates
//             these best.
//          5. Gather the boxes in that order, with a bit for each axis on which the box starts in
//             the cell.
//          6. In each cell test each box against those after it, by a sweep if the cell was sorted.
//          7. Report a pair only in its home cell, which the bits of step 5 decide.
//          8. Test each large box against all boxes.
// Departs: the cells have the proportions of the usual box and twice its size. They are runs of
//          sorted entries, so empty cells cost nothing. The home cell of a pair contains the
//          component-wise greater of the two minimum corners, so no pair comes twice. Dense cells
//          are swept along an axis.
// Fails:   sizes of many orders of magnitude: the cells suit nine boxes in ten, many small boxes
//          share a cell, and each of many large boxes is tested against every box. A world more
//          than 2^20 cells wide.
// Cost:    O(n) for boxes of about one size, spread out; about O(m^(5/3)) in a cell of m boxes,
//          O(n) for each large box. O(n) memory beside the output.
#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "algorithms/broad_phase.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_scan.h"
#include "algorithms/kernels/boxes/structure_boxes.h"
#include "algorithms/kernels/grid/cell_space.h"
#include "algorithms/kernels/grid/dense_cells.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {
namespace {

class UniformGrid final : public BroadPhase {
 public:
  explicit UniformGrid(Executor& executor) : executor_(executor) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    choose_cells(boxes);
    count_entries(boxes);
    write_entries(boxes);
    radix_sort_(executor_, entries_, shift_[2] + std::bit_width(space_.last[2]),
                [](const Entry& entry) { return entry.cell; });
    list_dense_cells(boxes);
    gather(boxes);
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    const std::size_t cell_tasks = block_count(entries_.size(), rows_a_task);
    const std::size_t large_tasks =
        large_.empty() ? 0 : block_count(arrays_.size(), columns_a_task);
    sink.start(cell_tasks + large_tasks);
    for_each_block(executor_, entries_.size(), rows_a_task,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     PairBuffer& out = sink.chunk(task);
                     visit_cells(first, last, [&](IndexRange rows, IndexRange cell, int axis) {
                       if (axis == no_axis) {
                         scan_marked_boxes(arrays_, marks_, wants_, rows, cell, out);
                       } else {
                         sweep_marked_boxes(arrays_, marks_, wants_, axis, rows, cell.last, out);
                       }
                     });
                   });
    if (large_.empty()) return Status::ok;
    for_each_block(executor_, arrays_.size(), columns_a_task,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     scan_marked_boxes(arrays_, marks_, wants_, large_rows(last), {first, last},
                                       sink.chunk(cell_tasks + task));
                   });
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    BroadPhaseWork sum{.box_tests = 0, .node_visits = 0, .candidates = 0};
    const auto add_scan = [&](IndexRange rows, IndexRange columns) {
      const auto tests = static_cast<std::int64_t>(pairs_of_scan(rows, columns));
      sum.box_tests += tests;
      sum.candidates += tests;
    };
    for (std::size_t first = 0; first < entries_.size(); first += rows_a_task) {
      visit_cells(first, std::min(first + rows_a_task, entries_.size()),
                  [&](IndexRange rows, IndexRange cell, int axis) {
                    ++sum.node_visits;
                    if (axis == no_axis) return add_scan(rows, cell);
                    const BroadPhaseWork swept = work_of_sweep(arrays_, axis, rows, cell.last);
                    sum.box_tests += swept.box_tests;
                    sum.candidates += swept.candidates;
                  });
    }
    add_scan(large_rows(arrays_.size()), {0, arrays_.size()});
    sum.bytes = sum_held_bytes(ids_, begins_, entries_, large_, radix_sort_, dense_cells_,
                               dense_sort_, arrays_, marks_, wants_);
    return sum;
  }

  // Level 0 is the large boxes, which lie in no cell and are tested against all; level 1 the cells.
  std::vector<StructureBox> structure() const override {
    const std::vector<Aabb> boxes = list_boxes(arrays_);
    const Aabb scene = bounds_of(boxes);
    std::vector<StructureBox> structure;
    for (std::size_t i = 0; i < large_.size(); ++i) structure.push_back({boxes[i], 0});
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (i > 0 && entries_[i].cell == entries_[i - 1].cell) continue;
      std::array<std::uint32_t, 3> cell;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint64_t mask = std::bit_ceil(space_.last[axis] + std::uint64_t{1}) - 1;
        cell[axis] = static_cast<std::uint32_t>(entries_[i].cell >> shift_[axis] & mask);
      }
      structure.push_back({box_of_cell(space_, cell, scene), 1});
    }
    return structure;
  }

 private:
  static constexpr std::size_t most_cells_a_box = 64;
  static constexpr double most_cells_an_axis = 1 << 20;
  static constexpr std::size_t boxes_a_block = 4096;
  static constexpr std::size_t rows_a_task = 512;
  static constexpr std::size_t columns_a_task = 8192;
  static constexpr std::uint32_t all_axes = 7;
  static constexpr std::size_t least_dense = 512;
  static constexpr int no_axis = -1;

  struct Entry {
    std::uint64_t cell;
    std::uint32_t id;
    std::uint32_t starts;  // bits of the axes on which the box's minimum lies in this cell
  };
  struct Cells {
    std::array<std::uint32_t, 3> low, high;
    std::size_t count() const {
      // Each factor is at most 2^20.
      return std::size_t{high[0] - low[0] + 1} * (high[1] - low[1] + 1) * (high[2] - low[2] + 1);
    }
  };

  void choose_cells(std::span<const Aabb> boxes) {
    const BoxSample sample = sample_boxes(boxes, ids_);
    space_.origin = sample.low;
    int bits = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = sample.high[axis] - sample.low[axis];
      const double side = std::max(2 * sample.side[axis], extent / most_cells_an_axis);
      space_.inverse_side[axis] = 1 / side;
      space_.last[axis] =
          static_cast<std::uint32_t>(std::min(extent / side, most_cells_an_axis - 1));
      shift_[axis] = bits;
      bits += std::bit_width(space_.last[axis]);
    }
  }

  Cells cells_of(const Aabb& box) const {
    Cells cells;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells.low[axis] = space_.cell(box.min[axis], axis);
      cells.high[axis] = space_.cell(box.max[axis], axis);
    }
    return cells;
  }

  // Finds where the entries and the large boxes of each block of boxes begin.
  void count_entries(std::span<const Aabb> boxes) {
    begins_.assign(block_count(ids_.size(), boxes_a_block), {});
    for_each_block(executor_, ids_.size(), boxes_a_block,
                   [&](std::size_t block, std::size_t first, std::size_t last) {
                     Begin counts;
                     for (std::size_t i = first; i < last; ++i) {
                       const std::size_t count = cells_of(boxes[ids_[i]]).count();
                       (count > most_cells_a_box ? counts.large : counts.entries) +=
                           count > most_cells_a_box ? 1 : count;
                     }
                     begins_[block] = counts;
                   });
    Begin end;
    for (Begin& begin : begins_) {
      end.entries += std::exchange(begin.entries, end.entries);
      end.large += std::exchange(begin.large, end.large);
    }
    entries_.resize(end.entries);
    large_.resize(end.large);
  }

  void write_entries(std::span<const Aabb> boxes) {
    for_each_block(executor_, ids_.size(), boxes_a_block,
                   [&](std::size_t block, std::size_t first, std::size_t last) {
                     Begin next = begins_[block];
                     for (std::size_t i = first; i < last; ++i) {
                       const Cells cells = cells_of(boxes[ids_[i]]);
                       if (cells.count() > most_cells_a_box) {
                         large_[next.large++] = ids_[i];
                       } else {
                         next.entries = enter(cells, ids_[i], next.entries);
                       }
                     }
                   });
  }

  std::size_t enter(const Cells& cells, std::uint32_t id, std::size_t at) {
    for (std::uint32_t z = cells.low[2]; z <= cells.high[2]; ++z) {
      for (std::uint32_t y = cells.low[1]; y <= cells.high[1]; ++y) {
        for (std::uint32_t x = cells.low[0]; x <= cells.high[0]; ++x) {
          const std::uint32_t starts = (x == cells.low[0] ? 1u : 0) | (y == cells.low[1] ? 2u : 0) |
                                       (z == cells.low[2] ? 4u : 0);
          entries_[at++] = {
              std::uint64_t{x} | std::uint64_t{y} << shift_[1] | std::uint64_t{z} << shift_[2], id,
              starts};
        }
      }
    }
    return at;
  }

  // Finds cells with many entries, and sorts each by its boxes' minima on an axis.
  void list_dense_cells(std::span<const Aabb> boxes) {
    dense_cells_.clear();
    visit_dense_cells(
        {0, entries_.size()}, least_dense, [&](std::size_t i) { return entries_[i].cell; },
        [&](IndexRange run) {
          const auto entries = std::span(entries_).subspan(run.first, run.last - run.first);
          const auto id = [](const Entry& entry) { return entry.id; };
          dense_cells_.push_back({run, dense_sort_(executor_, boxes, entries, id)});
        });
  }

  // Gathers the large boxes, then the entries. A cell is a pair's home if on each axis one of the
  // two boxes starts in it: `wants_` of a row holds the axes on which it does not start itself, and
  // `marks_` of the column must include them. A large box counts as starting everywhere and wants
  // all axes of the other box, which exactly one entry of a box has.
  void gather(std::span<const Aabb> boxes) {
    const std::size_t count = large_.size() + entries_.size();
    arrays_.gather(executor_, boxes, count, [&](std::size_t i) {
      return i < large_.size() ? large_[i] : entries_[i - large_.size()].id;
    });
    marks_.resize(count + AabbSoA::padding);
    wants_.resize(count + AabbSoA::padding);
    std::fill_n(marks_.begin(), large_.size(), all_axes);
    std::fill_n(wants_.begin(), large_.size(), all_axes);
    for_each_block(executor_, entries_.size(), 8192,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       marks_[large_.size() + i] = entries_[i].starts;
                       wants_[large_.size() + i] = all_axes & ~entries_[i].starts;
                     }
                   });
  }

  // The large boxes to test against the columns before `last`.
  IndexRange large_rows(std::size_t last) const { return {0, std::min(large_.size(), last)}; }

  // Calls visit(rows, cell, axis) for each cell with entries in [first, last): each row meets those
  // after it in the cell, by a sweep along `axis` unless that is no_axis.
  template <class Visit>
  void visit_cells(std::size_t first, std::size_t last, const Visit& visit) const {
    const auto places = [&](std::size_t from, std::size_t to) {
      return IndexRange{large_.size() + from, large_.size() + to};
    };
    auto dense_cell = std::ranges::upper_bound(dense_cells_, first, {}, &DenseCell::last);
    while (first < last) {
      std::size_t end = first + 1;
      int axis = no_axis;
      if (dense_cell != dense_cells_.end() && dense_cell->run.first <= first) {
        end = dense_cell->run.last;
        axis = dense_cell->axis;
        ++dense_cell;
      }
      while (end < entries_.size() && entries_[end].cell == entries_[first].cell) ++end;
      visit(places(first, std::min(end, last)), places(first, end), axis);
      first = end;
    }
  }

  struct DenseCell {
    IndexRange run;
    int axis;
    std::size_t last() const { return run.last; }
  };
  struct Begin {
    std::size_t entries = 0, large = 0;
  };

  Executor& executor_;
  std::vector<std::uint32_t> ids_;
  CellSpace space_;
  std::array<int, 3> shift_{};  // first bit of each axis's cell number in Entry::cell
  std::vector<Begin> begins_;
  std::vector<Entry> entries_;  // sorted by cell
  std::vector<std::uint32_t> large_;
  RadixSort<Entry> radix_sort_;
  std::vector<DenseCell> dense_cells_;
  DenseCellSort<Entry> dense_sort_;
  AabbSoA arrays_;
  std::vector<std::uint32_t> marks_, wants_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_uniform_grid() {
  return {{.info = {.name = "uniform-grid",
                    .citation = "Ericson, Real-Time Collision Detection, 2005, section 7.1; "
                                "Dittrich, Seeger, ICDE 2000 (home cell)"},
           .make = [](Executor& executor) { return std::make_unique<UniformGrid>(executor); }}};
}

}  // namespace touchstone::entries
