// Hierarchical grid: a grid for each size class; each box lies in one cell of the grid that suits
// it, and looks for partners in the cells around it and in those of the coarser grids.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 7.2; Mirtich, "Impulse-based
//          Dynamic Simulation of Rigid Body Systems", thesis, Berkeley 1996 (the hash of grids).
// Departs: no hash and no linked lists: boxes are sorted by cell, cells of a grid row by row, there
//          and back as an ox ploughs, so that a few cells side by side are one run of boxes, and an
//          index over the sorted cells finds it. 16 boxes that lie one behind the other look for
//          partners together. Cells are as large as the class' largest box, or larger where bodies
//          are sparse: about 16 boxes then lie in a cube of cells. A body meets those behind it, so
//          that each pair of cells is visited once.
// Fails:   crowds that the cells do not tell apart: bodies without volume, a dense cluster in a
//          region 500 times as wide, many bodies far outside the region where nearly all are. It is
//          then quadratic, with a small factor.
// Cost:    O(n) for keys and sort, O(n l + k) to be expected; l = classes in use, k = pairs in
//          neighbouring cells. About 65 bytes a body.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/cell_space.h"
#include "algorithms/kernels/group_scan.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/radix_sort.h"

namespace touchstone {
namespace {

class HierarchicalGrid final : public BroadPhase {
 public:
  explicit HierarchicalGrid(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    make_levels(boxes);
    sort(boxes);
    boxes_.gather(executor_, boxes, items_.size(), [&](std::size_t i) {
      return static_cast<std::uint32_t>(items_[i] & ((std::uint64_t{1} << id_bits_) - 1));
    });
    index_cells();
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    const std::size_t tasks = block_count(groups_, groups_a_task);
    sink.start(tasks);
    const auto search = [&](std::size_t task, int worker) {
      Scratch& scratch = scratch_[static_cast<std::size_t>(worker)];
      const std::size_t last = std::min((task + 1) * groups_a_task, groups_);
      for (std::size_t group = task * groups_a_task; group < last; ++group) {
        pair_group(group, scratch, sink.chunk(task));
      }
    };
    executor_.run(tasks, std::cref(search));
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    Scratch scratch;
    PairBuffer pairs;
    for (std::size_t group = 0; group < groups_; ++group) {
      pairs.clear();
      pair_group(group, scratch, pairs);
    }
    scratch.group.work.bytes = sum_held_bytes(ids_, measures_, items_, radix_sort_, boxes_, index_);
    return scratch.group.work;
  }

 private:
  static constexpr std::size_t block_size = 8192;
  static constexpr std::size_t groups_a_task = 32;
  static constexpr std::size_t most_levels = 16;
  // A class of fewer goes into the next larger one.
  static constexpr std::size_t least_members = 64;
  static constexpr double most_cells = 1 << 27;  // a level: the keys of all fit in 32 bits
  // Cells of a row are finer than the rows are wide: they cost nothing, since a run has many.
  static constexpr double cells_a_width = 4;
  // Powers of two that a float can have.
  static constexpr std::size_t magnitudes = 256;

  // Of the boxes of one magnitude.
  struct Measure {
    std::size_t members = 0;
    std::array<double, 3> side{};  // the longest on each axis
    void add(const Measure& other) {
      members += other.members;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        side[axis] = std::max(side[axis], other.side[axis]);
      }
    }
  };
  using Measures = std::array<Measure, magnitudes>;

  struct Level {
    CellSpace space;                   // of the boxes' minimum corners
    std::array<double, 3> reach;       // no box is longer
    std::array<std::size_t, 3> count;  // of cells
    std::uint64_t first_cell;          // of the level's, among those of all
    IndexRange boxes;
    std::size_t first_group;
  };
  struct Scratch {
    std::vector<IndexRange> partners;
    GroupScratch group;
  };

  static std::size_t magnitude(const Aabb& box) {
    const float side =
        std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
    return std::bit_cast<std::uint32_t>(side) >> 23 & (magnitudes - 1);
  }

  std::span<const Level> levels() const { return {levels_.data(), used_}; }

  Measures measure(std::span<const Aabb> boxes);
  void make_levels(std::span<const Aabb> boxes);
  void choose_cells(const Measure& measure, const BoxSample& sample, double crowd, Level& level);
  void sort(std::span<const Aabb> boxes);
  void index_cells();

  // Along the row axis the cells of each second row are numbered backwards, and so are the rows of
  // each second slab: whose boxes are next in the order are near.
  std::uint64_t first_of_row(const Level& level, std::size_t row, std::size_t slab) const {
    const std::size_t rows = level.count[axis_[1]];
    const std::size_t place = slab * rows + (slab % 2 == 0 ? row : rows - 1 - row);
    return level.first_cell + place * level.count[axis_[0]];
  }
  static bool is_backward(std::uint64_t first_of_row, const Level& level, std::size_t length) {
    return (first_of_row - level.first_cell) / length % 2 != 0;
  }

  // The first box in this cell or behind it.
  std::size_t find(std::uint64_t cell) const {
    const std::uint64_t entry = cell >> index_shift_;
    if (index_shift_ == 0) return index_[entry];
    const auto begin = items_.begin();
    return static_cast<std::size_t>(
        std::lower_bound(begin + index_[entry], begin + index_[entry + 1], cell << id_bits_) -
        begin);
  }

  void pair_group(std::size_t group, Scratch& scratch, PairBuffer& out) const;
  void find_partners(const Level& level, const Aabb& bounds, std::size_t from,
                     Scratch& scratch) const;

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  std::vector<Measures> measures_;  // of the blocks
  std::array<std::uint8_t, magnitudes> level_of_{};
  std::array<Level, most_levels> levels_;
  std::size_t used_ = 0;
  std::array<std::size_t, 3> axis_{0, 1, 2};  // along rows, across rows, across slabs
  std::uint64_t cells_ = 0;                   // of all levels
  std::vector<std::uint64_t> items_;          // cell above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  BoxArrays boxes_;                   // in the order of the items
  std::vector<std::uint32_t> index_;  // of each 2^shift cells, the first box there or behind
  int index_shift_ = 0;
  std::size_t groups_ = 0;
};

HierarchicalGrid::Measures HierarchicalGrid::measure(std::span<const Aabb> boxes) {
  measures_.assign(block_count(ids_.size(), block_size), {});
  for_each_block(executor_, ids_.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   Measures& into = measures_[block];
                   for (std::size_t i = first; i < last; ++i) {
                     const Aabb& box = boxes[ids_[i]];
                     Measure own{.members = 1};
                     for (std::size_t axis = 0; axis < 3; ++axis) {
                       own.side[axis] = double{box.max[axis]} - box.min[axis];
                     }
                     into[magnitude(box)].add(own);
                   }
                 });
  Measures all{};
  for (const Measures& block : measures_) {
    for (std::size_t i = 0; i < magnitudes; ++i) all[i].add(block[i]);
  }
  return all;
}

// Cells as large as the largest box, or so large that a cube of them has 16 bodies.
void HierarchicalGrid::choose_cells(const Measure& measure, const BoxSample& sample, double crowd,
                                    Level& level) {
  std::array<double, 3> extent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    level.reach[axis] = measure.side[axis] * (1 + 0x1p-16);  // no rounding makes it too short
    extent[axis] = std::max(sample.high[axis] - sample.low[axis], level.reach[axis]);
  }
  // Axes on which the region is thinner than that have one cell, and the others share the bodies.
  std::array<std::size_t, 3> by_extent{0, 1, 2};
  std::ranges::sort(by_extent, {}, [&](std::size_t axis) { return extent[axis]; });
  const double groups = std::max(1.0, static_cast<double>(measure.members) * crowd / group_size);
  double spacing = 0;
  for (std::size_t thin = 0; thin < 3; ++thin) {
    double log_spacing = -std::log(groups);
    for (std::size_t i = thin; i < 3; ++i) log_spacing += std::log(extent[by_extent[i]]);
    spacing = std::exp(log_spacing / static_cast<double>(3 - thin));
    if (extent[by_extent[thin]] > spacing) break;
  }
  std::array<double, 3> side;
  for (std::size_t axis = 0; axis < 3; ++axis) side[axis] = std::max(spacing, level.reach[axis]);
  side[axis_[0]] /= cells_a_width;
  level.space.origin = sample.low;
  while (true) {
    double cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Where nothing has an extent, one cell.
      const double last = side[axis] > 0 ? std::floor(extent[axis] / side[axis]) : 0;
      level.space.inverse_side[axis] = side[axis] > 0 ? 1 / side[axis] : 0;
      level.space.last[axis] = static_cast<std::uint32_t>(std::min(last, most_cells));
      level.count[axis] = level.space.last[axis] + std::size_t{1};
      cells *= last + 1;
    }
    if (cells <= most_cells) break;
    for (double& s : side) s *= 2;
  }
}

void HierarchicalGrid::make_levels(std::span<const Aabb> boxes) {
  used_ = 0;
  cells_ = 0;
  groups_ = 0;
  if (ids_.empty()) return;
  const BoxSample sample = sample_boxes(boxes, ids_);
  const Measures measures = measure(boxes);
  const double crowd = crowding(boxes, ids_, sample);
  axis_ = {0, 1, 2};
  std::ranges::stable_sort(axis_, std::greater(), [&](std::size_t axis) {
    return (sample.high[axis] - sample.low[axis]) / sample.side[axis];
  });
  // From the smallest up. A level is closed when it has members enough; the largest few have one of
  // their own, however few they are.
  Measure open;
  std::size_t place = 0;
  for (std::size_t i = 0; i < magnitudes; ++i) {
    level_of_[i] = static_cast<std::uint8_t>(used_);
    open.add(measures[i]);
    const bool last = i + 1 == magnitudes;
    if (open.members == 0) continue;
    if (!last && (open.members < least_members || used_ + 1 == most_levels)) continue;
    Level& level = levels_[used_++];
    choose_cells(open, sample, crowd, level);
    level.first_cell = cells_;
    cells_ += level.count[0] * level.count[1] * level.count[2];
    level.boxes = {place, place + open.members};
    level.first_group = groups_;
    groups_ += block_count(open.members, group_size);
    place += open.members;
    open = {};
  }
}

void HierarchicalGrid::sort(std::span<const Aabb> boxes) {
  items_.resize(ids_.size());
  id_bits_ = static_cast<int>(std::bit_width(boxes.size()));
  for_each_block(executor_, ids_.size(), block_size,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const Aabb& box = boxes[ids_[i]];
                     const Level& level = levels_[level_of_[magnitude(box)]];
                     std::array<std::size_t, 3> cell;
                     for (std::size_t k = 0; k < 3; ++k) {
                       cell[k] = level.space.cell(box.min[axis_[k]], axis_[k]);
                     }
                     const std::size_t length = level.count[axis_[0]];
                     std::uint64_t key = first_of_row(level, cell[1], cell[2]);
                     key += is_backward(key, level, length) ? length - 1 - cell[0] : cell[0];
                     items_[i] = key << id_bits_ | ids_[i];
                   }
                 });
  radix_sort_(executor_, items_, static_cast<int>(std::bit_width(cells_)),
              [bits = id_bits_](std::uint64_t item) { return item >> bits; });
}

// At most four entries a body.
void HierarchicalGrid::index_cells() {
  index_shift_ = 0;
  while (cells_ >> index_shift_ > 4 * items_.size()) ++index_shift_;
  const std::size_t entries = (cells_ >> index_shift_) + 2;
  index_.resize(entries);
  const auto entry_of = [&](std::size_t i) { return items_[i] >> id_bits_ >> index_shift_; };
  for_each_block(executor_, items_.size(), block_size,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   std::size_t entry = first == 0 ? 0 : entry_of(first - 1) + 1;
                   for (std::size_t i = first; i < last; ++i) {
                     for (const std::size_t own = entry_of(i); entry <= own; ++entry) {
                       index_[entry] = static_cast<std::uint32_t>(i);
                     }
                   }
                 });
  const std::size_t behind = items_.empty() ? 0 : entry_of(items_.size() - 1) + 1;
  std::fill(index_.begin() + static_cast<std::ptrdiff_t>(behind), index_.end(),
            static_cast<std::uint32_t>(items_.size()));
}

void HierarchicalGrid::pair_group(std::size_t group, Scratch& scratch, PairBuffer& out) const {
  std::size_t own = 0;
  while (own + 1 < used_ && levels_[own + 1].first_group <= group) ++own;
  const Level& level = levels_[own];
  const std::size_t first = level.boxes.first + (group - level.first_group) * group_size;
  const IndexRange members{first, std::min(first + group_size, level.boxes.last)};
  const Aabb bounds = bounds_of(boxes_, members);
  scratch.partners.clear();
  for (const Level& other : levels().subspan(own)) {
    find_partners(other, bounds, members.last, scratch);
  }
  scan_group(boxes_, members, bounds, scratch.partners, scratch.group, out);
}

// The boxes from `from` on in the cells of a level where boxes that overlap these bounds may be.
void HierarchicalGrid::find_partners(const Level& level, const Aabb& bounds, std::size_t from,
                                     Scratch& scratch) const {
  if (from >= level.boxes.last) return;
  std::array<std::size_t, 3> low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t axis = axis_[k];
    low[k] = level.space.cell(bounds.min[axis] - level.reach[axis], axis);
    high[k] = level.space.cell(bounds.max[axis], axis);
  }
  const auto add = [&](IndexRange run) {
    ++scratch.group.work.node_visits;
    run.first = std::max(run.first, from);
    if (run.first >= run.last) return;
    auto& runs = scratch.partners;
    if (!runs.empty() && runs.back().last == run.first) {
      runs.back().last = run.last;
    } else {
      runs.push_back(run);
    }
  };
  // More rows than boxes: rather all boxes of these slabs.
  const std::size_t rows = level.count[axis_[1]];
  const std::size_t length = level.count[axis_[0]];
  const std::size_t slabs = high[2] - low[2] + 1;
  if ((high[1] - low[1] + 1) * slabs * 4 > level.boxes.last - std::max(from, level.boxes.first)) {
    const std::uint64_t slab = level.first_cell + low[2] * rows * length;
    return add({find(slab), find(slab + slabs * rows * length)});
  }
  const std::uint64_t own_cell = items_[from] >> id_bits_;
  for (std::size_t slab = low[2]; slab <= high[2]; ++slab) {
    for (std::size_t row = low[1]; row <= high[1]; ++row) {
      const std::uint64_t cell = first_of_row(level, row, slab);
      const bool backward = is_backward(cell, level, length);
      const std::uint64_t first = cell + (backward ? length - 1 - high[0] : low[0]);
      const std::uint64_t last = first + (high[0] - low[0]);
      if (last < own_cell) continue;
      add({find(first), find(last + 1)});
    }
  }
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {{.info = {.name = "hierarchical-grid",
                    .citation = "Ericson, Real-Time Collision Detection, 2005, section 7.2; "
                                "Mirtich, thesis, Berkeley 1996; sorted cells"},
           .make = [](touchstone::Executor& executor) {
             return std::make_unique<touchstone::HierarchicalGrid>(executor);
           }}};
}
