// Hierarchical grid: a grid for each size class; each box lies in one cell of the grid that suits
// it, and looks for partners in the cells around it and in those of the coarser grids.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 7.2; Mirtich, "Impulse-based
//          Dynamic Simulation of Rigid Body Systems", thesis, Berkeley 1996 (the hash of grids).
// Departs: no hash and no linked lists: boxes are sorted by cell, so that a few cells side by side
//          are one run of boxes, and an index over the sorted cells finds it. 16 boxes that lie one
//          behind the other look for partners together. Cells are as large as the class' largest
//          box, or larger where bodies are sparse: about 16 boxes then lie in a cube of cells. What
//          crowds in one cell, as a dense cluster in a wide world does, gets a grid of its own. A
//          body meets those behind it, so that each pair of cells is visited once.
// Fails:   long thin boxes in all directions: a cell is as long as they are, on each axis.
// Cost:    O(n) for keys and sort, O(n l + k) to be expected; l = grids in use, k = pairs in
//          neighbouring cells. About 65 bytes a body.
#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_measures.h"
#include "algorithms/kernels/cell_space.h"
#include "algorithms/kernels/crowds.h"
#include "algorithms/kernels/group_scan.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/ploughed_grid.h"
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
    for (std::size_t level = 0; level < levels_.size(); ++level) split_crowds(boxes, level);
    boxes_.gather(executor_, boxes, items_.size(), [&](std::size_t i) { return id(i); });
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
    scratch.group.work.bytes =
        sum_held_bytes(ids_, measures_, levels_, items_, radix_sort_, crowds_, before_, crowd_,
                       crowd_sort_, boxes_, index_);
    return scratch.group.work;
  }

 private:
  static constexpr std::size_t block_size = 8192;
  static constexpr std::size_t groups_a_task = 32;
  static constexpr std::size_t most_classes = 16;
  // A class of fewer goes into the next larger one.
  static constexpr std::size_t least_members = 64;
  // So many in one cell are a crowd, which is split if it has room for so many cells.
  static constexpr std::size_t least_crowd = 256;
  static constexpr std::uint64_t least_cells = 64;
  static constexpr Aabb everywhere{
      {std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
       std::numeric_limits<float>::lowest()},
      {std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
       std::numeric_limits<float>::max()}};

  struct Level {
    PloughedGrid grid;
    std::uint64_t first_cell = 0;  // of the level's, among those of all
    IndexRange boxes{0, 0};
    Aabb bounds = everywhere;  // of them, of a crowd
    std::size_t first_group = 0;
    std::size_t first_entry = 0;  // in the index
    int index_shift = 0;
  };
  struct Scratch {
    std::vector<IndexRange> partners;
    GroupScratch group;
  };

  std::uint64_t cell(std::size_t place) const { return items_[place] >> id_bits_; }
  std::uint32_t id(std::size_t place) const {
    return static_cast<std::uint32_t>(items_[place] & ((std::uint64_t{1} << id_bits_) - 1));
  }
  std::uint64_t item(const Level& level, const Aabb& box, std::uint32_t id) const {
    return (level.first_cell + level.grid.cell_of(box)) << id_bits_ | id;
  }
  void take_cells(Level& level) {
    level.first_cell = cells_;
    cells_ += level.grid.cells();
  }

  void make_levels(std::span<const Aabb> boxes);
  void sort(std::span<const Aabb> boxes);
  void split_crowds(std::span<const Aabb> boxes, std::size_t level);
  void list_crowds(std::span<const Aabb> boxes, IndexRange range);
  Level level_of_crowd(std::span<const Aabb> boxes, IndexRange crowd) const;
  void sort_crowd(std::span<const Aabb> boxes, const Level& level);
  void index_cells();
  // The first box in this cell of the level or behind it.
  std::size_t find(const Level& level, std::uint64_t cell) const {
    const std::uint64_t entry = level.first_entry + (cell >> level.index_shift);
    if (level.index_shift == 0) return index_[entry];
    const auto begin = items_.begin();
    return static_cast<std::size_t>(std::lower_bound(begin + index_[entry],
                                                     begin + index_[entry + 1],
                                                     (level.first_cell + cell) << id_bits_) -
                                    begin);
  }
  void pair_group(std::size_t group, Scratch& scratch, PairBuffer& out) const;
  void find_partners(const Level& level, const Aabb& bounds, std::size_t from,
                     Scratch& scratch) const;

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  std::vector<BoxMeasures> measures_;
  PloughedGrid::Axes axes_{0, 1, 2};
  std::array<std::uint8_t, box_magnitudes> level_of_{};
  std::vector<Level> levels_;         // by size; the crowds of each come behind it
  std::uint64_t cells_ = 0;           // of all levels
  std::vector<std::uint64_t> items_;  // cell above, id below
  int id_bits_ = 0;
  RadixSort<std::uint64_t> radix_sort_;
  std::vector<Level> crowds_;                  // of a level
  std::vector<std::uint64_t> before_, crowd_;  // items of the level, and of one crowd
  RadixSort<std::uint64_t> crowd_sort_;
  BoxArrays boxes_;                   // in the order of the items
  std::vector<std::uint32_t> index_;  // of each 2^shift cells, the first box there or behind
  std::size_t groups_ = 0;
};

void HierarchicalGrid::make_levels(std::span<const Aabb> boxes) {
  levels_.clear();
  cells_ = 0;
  if (ids_.empty()) return;
  const BoxSample sample = sample_boxes(boxes, ids_);
  const BoxMeasures measures = measure_boxes(executor_, boxes, ids_, measures_);
  const double crowd = crowding(boxes, ids_, sample);
  axes_ = {0, 1, 2};
  std::ranges::stable_sort(axes_, std::greater(), [&](std::size_t axis) {
    return (sample.high[axis] - sample.low[axis]) / sample.side[axis];
  });
  // From the smallest up. A level is closed when it has members enough; the largest few have one of
  // their own, however few they are.
  BoxMeasure open;
  std::size_t place = 0;
  for (std::size_t i = 0; i < box_magnitudes; ++i) {
    level_of_[i] = static_cast<std::uint8_t>(levels_.size());
    open.add(measures[i]);
    const bool last = i + 1 == box_magnitudes;
    if (open.members == 0) continue;
    if (!last && (open.members < least_members || levels_.size() + 1 == most_classes)) continue;
    const double groups = std::max(1.0, static_cast<double>(open.members) * crowd / group_size);
    Level level{.grid = {axes_, open.side, sample.low, sample.high, groups},
                .boxes = {place, place + open.members}};
    take_cells(level);
    levels_.push_back(level);
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
                     items_[i] = item(levels_[level_of_[magnitude(box)]], box, ids_[i]);
                   }
                 });
  radix_sort_(executor_, items_, static_cast<int>(std::bit_width(cells_)),
              [bits = id_bits_](std::uint64_t item) { return item >> bits; });
}

// The crowds of a level become levels behind it, which may have crowds themselves.
void HierarchicalGrid::split_crowds(std::span<const Aabb> boxes, std::size_t level) {
  list_crowds(boxes, levels_[level].boxes);
  if (crowds_.empty()) return;
  IndexRange& own = levels_[level].boxes;
  const auto begin = items_.begin();
  before_.assign(begin + own.first, begin + own.last);
  const auto before = [&](std::size_t place) { return before_.begin() + (place - own.first); };
  std::size_t next = own.first;
  auto end = begin + own.first;
  for (const Level& crowd : crowds_) {
    end = std::copy(before(next), before(crowd.boxes.first), end);
    next = crowd.boxes.last;
  }
  end = std::copy(before(next), before_.end(), end);
  const auto kept = static_cast<std::size_t>(end - begin);
  for (Level& crowd : crowds_) {
    crowd_.assign(before(crowd.boxes.first), before(crowd.boxes.last));
    crowd.boxes = {static_cast<std::size_t>(end - begin), 0};
    crowd.boxes.last = crowd.boxes.first + crowd_.size();
    take_cells(crowd);
    sort_crowd(boxes, crowd);
    end = std::copy(crowd_.begin(), crowd_.end(), end);
  }
  own.last = kept;
  levels_.insert(levels_.begin() + level + 1, crowds_.begin(), crowds_.end());
}

void HierarchicalGrid::list_crowds(std::span<const Aabb> boxes, IndexRange range) {
  crowds_.clear();
  visit_crowds(
      range, least_crowd, [&](std::size_t i) { return cell(i); },
      [&](IndexRange crowd) {
        const Level level = level_of_crowd(boxes, crowd);
        if (level.grid.cells() >= least_cells) crowds_.push_back(level);
      });
}

HierarchicalGrid::Level HierarchicalGrid::level_of_crowd(std::span<const Aabb> boxes,
                                                         IndexRange crowd) const {
  BoxMeasure measure;
  Aabb bounds = Aabb::empty();
  std::array<double, 3> low, high;
  high.fill(std::numeric_limits<double>::lowest());
  for (std::size_t i = crowd.first; i < crowd.last; ++i) {
    const Aabb& box = boxes[id(i)];
    measure.add(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::min(bounds.min[axis], box.min[axis]);
      bounds.max[axis] = std::max(bounds.max[axis], box.max[axis]);
      low[axis] = bounds.min[axis];
      high[axis] = std::max(high[axis], double{box.min[axis]});
    }
  }
  const double groups = static_cast<double>(measure.members) / group_size;
  return {.grid = {axes_, measure.side, low, high, groups}, .boxes = crowd, .bounds = bounds};
}

void HierarchicalGrid::sort_crowd(std::span<const Aabb> boxes, const Level& level) {
  const std::uint64_t ids = (std::uint64_t{1} << id_bits_) - 1;
  for (std::uint64_t& own : crowd_) {
    const auto body = static_cast<std::uint32_t>(own & ids);
    own = item(level, boxes[body], body);
  }
  if (crowd_.size() < 2048) {
    std::ranges::sort(crowd_);
    return;
  }
  crowd_sort_(executor_, crowd_, static_cast<int>(std::bit_width(level.grid.cells())),
              [bits = id_bits_, first = level.first_cell](std::uint64_t item) {
                return (item >> bits) - first;
              });
}

// At most four entries a body.
void HierarchicalGrid::index_cells() {
  groups_ = 0;
  std::size_t entries = 0;
  for (Level& level : levels_) {
    const std::size_t members = level.boxes.last - level.boxes.first;
    level.first_group = groups_;
    groups_ += block_count(members, group_size);
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
    for_each_block(executor_, level.boxes.last - begin, block_size,
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

void HierarchicalGrid::pair_group(std::size_t group, Scratch& scratch, PairBuffer& out) const {
  // The last that begins there or before: empty ones begin where the next one does.
  const auto own = std::ranges::upper_bound(levels_, group, {}, &Level::first_group) - 1;
  const std::size_t first = own->boxes.first + (group - own->first_group) * group_size;
  const IndexRange members{first, std::min(first + group_size, own->boxes.last)};
  const Aabb bounds = bounds_of(boxes_, members);
  scratch.partners.clear();
  for (auto level = own; level != levels_.end(); ++level) {
    if (overlap(level->bounds, bounds)) find_partners(*level, bounds, members.last, scratch);
  }
  scan_group(boxes_, members, bounds, scratch.partners, scratch.group, out);
}

// The boxes from `from` on in the cells of a level where boxes that overlap these bounds may be.
void HierarchicalGrid::find_partners(const Level& level, const Aabb& bounds, std::size_t from,
                                     Scratch& scratch) const {
  if (from >= level.boxes.last) return;
  const PloughedGrid::Window window = level.grid.window(bounds);
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
  const std::size_t left = level.boxes.last - std::max(from, level.boxes.first);
  if (window.rows() * window.slabs() * 4 > left) {
    return add({find(level, level.grid.first_cell_of_slab(window.low[2])),
                find(level, level.grid.first_cell_of_slab(window.high[2] + 1))});
  }
  const std::uint64_t own_cell = from > level.boxes.first ? cell(from) - level.first_cell : 0;
  for (std::size_t slab = window.low[2]; slab <= window.high[2]; ++slab) {
    for (std::size_t row = window.low[1]; row <= window.high[1]; ++row) {
      const std::uint64_t first = level.grid.first_cell(window, row, slab);
      const std::uint64_t end = first + window.length();
      if (end > own_cell) add({find(level, first), find(level, end)});
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
