// Loose octree: each box lies in one cell, at the level of its size; its partners lie nearby.
// Paper:   Ulrich, "Loose Octrees", Game Programming Gems, 2000; Gargantini, "An Effective Way to
//          Represent Quadtrees", CACM 1982 (linear: sorted codes instead of nodes).
// Departs: no nodes: the cells are runs of boxes sorted by level and Morton code, found through a
//          hash table. Cells have the proportions of the usual box, and a level's are as wide as
//          its largest boxes; the looseness is 2, so a box reaches at most half a cell beyond its
//          own. Pairs are sought at the own level and at coarser ones only.
// Fails:   crowds of boxes of a size within one cell (stacks), where it is quadratic; a few dozen
//          look-ups for each box and level make it slow where sizes are of many orders.
// Cost:    O(n log n + n l + k) time, O(n) memory beside the output; l = levels in use, at most 20,
//          k = pairs in neighbouring cells.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_scan.h"
#include "algorithms/kernels/cell_space.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/morton.h"
#include "algorithms/kernels/radix_sort.h"

namespace touchstone {
namespace {

class LooseOctree final : public BroadPhase {
 public:
  explicit LooseOctree(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    choose_cells(boxes);
    items_.resize(ids_.size());
    for_each_block(executor_, ids_.size(), 4096,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       items_[i] = {cell_of(boxes[ids_[i]]), ids_[i]};
                     }
                   });
    radix_sort_(executor_, items_, 3 * top_ + std::bit_width(static_cast<unsigned>(top_)),
                [](const Item& item) { return item.cell; });
    arrays_.gather(executor_, boxes, items_.size(), [&](std::size_t i) { return items_[i].id; });
    list_cells();
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    const std::size_t tasks = block_count(items_.size(), rows_a_task);
    sink.start(tasks);
    const auto scan = [&](std::size_t task, int worker) {
      Scratch& scratch = scratch_[static_cast<std::size_t>(worker)];
      const auto nothing = [](const Window&, const CellNumbers*) {};
      visit_groups(rows_of(task), scratch, nothing, [&](IndexRange group) {
        scan_boxes(arrays_, group, scratch.columns, sink.chunk(task));
      });
    };
    executor_.run(tasks, std::cref(scan));
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    Scratch scratch;
    std::size_t tests = 0;
    std::size_t visits = 0;
    const auto count_cells = [&](const Window& window, const CellNumbers* own) {
      visits += cells_of_runs(window, own);
    };
    for (std::size_t task = 0; task < block_count(items_.size(), rows_a_task); ++task) {
      visit_groups(rows_of(task), scratch, count_cells, [&](IndexRange group) {
        ++visits;
        for (const IndexRange columns : scratch.columns) tests += pairs_of_scan(group, columns);
      });
    }
    return {.box_tests = static_cast<std::int64_t>(tests),
            .node_visits = static_cast<std::int64_t>(visits),
            .candidates = static_cast<std::int64_t>(tests),
            .bytes = sum_held_bytes(ids_, items_, radix_sort_, arrays_, cells_, table_, filter_)};
  }

 private:
  static constexpr int most_levels = 20;  // 3 * 19 bits of code, 5 of level
  static constexpr std::size_t rows_a_task = 512;
  static constexpr std::size_t filter_share = 8;  // bits a slot of the table
  static constexpr std::uint64_t no_cell = ~std::uint64_t{0};

  struct Item {
    std::uint64_t cell;  // level above, Morton code in the level's own cells below
    std::uint32_t id;
  };
  struct Cell {
    std::uint64_t cell = no_cell;
    std::uint32_t first = 0, last = 0;  // its boxes
  };
  // The cells of a level where partners of a group of boxes may be.
  struct Window {
    CellNumbers low, high;
    friend bool operator==(const Window&, const Window&) = default;
  };
  struct Scratch {
    std::vector<IndexRange> columns;
    // The last window at each level and its runs of boxes: small boxes that are near each other in
    // the order mostly share their windows at the coarser levels.
    std::array<Window, most_levels> windows;
    std::array<std::vector<IndexRange>, most_levels> runs;
  };

  // Level l has cells of finest * 2^l usual boxes. Levels are set so that the usual box just fits
  // in a cell. At the top there is one cell for all.
  void choose_cells(std::span<const Aabb> boxes) {
    const BoxSample sample = sample_boxes(boxes, ids_);
    const double extent = sample.extent();
    const double least = std::ldexp(extent, 1 - most_levels);
    double finest = sample.usual * (1 + 1.0 / 64);  // boxes of one size differ by rounding
    if (finest == 0) finest = extent > 0 ? least : 1;
    for (int halvings = 0; halvings < most_levels; ++halvings) {
      if (finest / 2 < std::max(sample.smallest, least)) break;
      finest /= 2;
    }
    while (finest < least) finest *= 2;
    top_ = 0;
    while (std::ldexp(finest, top_) < extent && top_ < most_levels - 1) ++top_;
    space_.origin = sample.low;
    space_.last.fill((1u << top_) - 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side_[axis] = finest * sample.side[axis];
      space_.inverse_side[axis] = 1 / side_[axis];
    }
  }

  std::uint64_t cell_of(const Aabb& box) const {
    const int level = level_of(space_.size(box));
    CellNumbers cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double centre = 0.5 * (double{box.min[axis]} + box.max[axis]);
      cell[axis] = space_.cell(centre, axis) >> level;
    }
    return static_cast<std::uint64_t>(level) << (3 * top_) | morton_code(cell);
  }

  // The least level whose cells are at least as large, or the top. `size` is in finest cells.
  int level_of(double size) const {
    if (!(size > 1)) return 0;
    const auto bits = std::bit_cast<std::uint64_t>(size);
    const bool is_power = (bits & ((std::uint64_t{1} << 52) - 1)) == 0;
    const int level = static_cast<int>(bits >> 52) - 1023 + (is_power ? 0 : 1);
    return std::min(level, top_);
  }

  void list_cells() {
    cells_.clear();
    levels_ = 0;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const auto place = static_cast<std::uint32_t>(i);
      if (cells_.empty() || items_[i].cell != cells_.back().cell) {
        cells_.push_back({items_[i].cell, place, place});
        levels_ |= 1u << (items_[i].cell >> (3 * top_));
      }
      cells_.back().last = place + 1;
    }
    table_bits_ = static_cast<int>(std::bit_width(2 * cells_.size()));
    table_.assign(std::size_t{1} << table_bits_, {});
    filter_.assign(block_count(table_.size() * filter_share, 64), 0);
    for (const Cell& cell : cells_) {
      table_[slot(cell.cell)] = cell;
      const std::size_t bit = filter_bit(cell.cell);
      filter_[bit / 64] |= std::uint64_t{1} << bit % 64;
    }
  }

  // Multiplicative hashing (Knuth, The Art of Computer Programming, volume 3, section 6.4).
  static std::uint64_t hash(std::uint64_t cell) { return cell * 0x9e3779b97f4a7c15; }

  // Where a cell is in the table, or where it would go. Linear probing; the table is at most half
  // full.
  std::size_t slot(std::uint64_t cell) const {
    std::size_t at = hash(cell) >> (64 - table_bits_);
    while (table_[at].cell != cell && table_[at].cell != no_cell) {
      at = (at + 1) & (table_.size() - 1);
    }
    return at;
  }

  // Set for each cell of the table. Most cells that are asked for are empty, and this many bits
  // stay in the cache where the table does not.
  std::size_t filter_bit(std::uint64_t cell) const {
    return hash(cell) >> (64 - table_bits_ - std::countr_zero(filter_share));
  }

  IndexRange rows_of(std::size_t task) const {
    const std::size_t first = task * rows_a_task;
    return {first, std::min(first + rows_a_task, items_.size())};
  }

  // Calls visit(group) for the boxes of each cell: they are to meet those of scratch.columns, which
  // are those behind them in their cell, in half of the cells around it and at the coarser levels.
  // Calls look(window, own) for each window whose cells are looked up for that, as find_runs does.
  template <class Look, class Visit>
  void visit_groups(IndexRange rows, Scratch& scratch, const Look& look, const Visit& visit) const {
    for (auto& runs : scratch.runs) runs.clear();
    scratch.windows.fill({{1, 1, 1}, {0, 0, 0}});
    auto cell = std::ranges::upper_bound(cells_, rows.first, {}, &Cell::first) - 1;
    for (std::size_t first = rows.first; first < rows.last; ++cell) {
      const IndexRange group{first, std::min<std::size_t>(cell->last, rows.last)};
      scratch.columns.assign(1, {cell->first, cell->last});
      add_partners(group, cell->cell, scratch, look);
      visit(group);
      first = cell->last;
    }
  }

  template <class Look>
  void add_partners(IndexRange group, std::uint64_t cell, Scratch& scratch,
                    const Look& look) const {
    std::array<double, 3> low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const float* min = arrays_.min(axis);
      const float* max = arrays_.max(axis);
      low[k] = *std::min_element(min + group.first, min + group.last);
      high[k] = *std::max_element(max + group.first, max + group.last);
    }
    const int own_level = static_cast<int>(cell >> (3 * top_));
    for (unsigned levels = levels_ >> own_level << own_level; levels != 0; levels &= levels - 1) {
      const int level = std::countr_zero(levels);
      const auto l = static_cast<std::size_t>(level);
      // The centre of a partner is at most half a cell away. The 64th part is for rounding; a box
      // for which that is not enough has no length on the axis, and its centre is its end.
      const double reach = (0.5 + 1.0 / 64) * (1u << level);
      Window window;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        window.low[axis] = space_.cell(low[axis] - reach * side_[axis], axis) >> level;
        window.high[axis] = space_.cell(high[axis] + reach * side_[axis], axis) >> level;
      }
      if (level == own_level) {
        const std::uint64_t code = cell & ((std::uint64_t{1} << (3 * top_)) - 1);
        const CellNumbers own = morton_cell(code);
        look(window, &own);
        find_runs(window, level, &own, scratch.columns);
        continue;
      }
      if (window != scratch.windows[l]) {
        scratch.windows[l] = window;
        scratch.runs[l].clear();
        look(window, nullptr);
        find_runs(window, level, nullptr, scratch.runs[l]);
      }
      scratch.columns.insert(scratch.columns.end(), scratch.runs[l].begin(), scratch.runs[l].end());
    }
  }

  // Adds the runs of boxes of the window's cells, and of those only that come behind `own` (by z,
  // y, x) where the level is the boxes' own.
  void find_runs(const Window& window, int level, const CellNumbers* own,
                 std::vector<IndexRange>& runs) const {
    const std::uint64_t prefix = static_cast<std::uint64_t>(level) << (3 * top_);
    const std::uint64_t first_x = spread_bits(window.low[0]);
    for (std::uint32_t z = own != nullptr ? (*own)[2] : window.low[2]; z <= window.high[2]; ++z) {
      const bool own_slab = own != nullptr && z == (*own)[2];
      for (std::uint32_t y = own_slab ? (*own)[1] : window.low[1]; y <= window.high[1]; ++y) {
        const bool own_row = own_slab && y == (*own)[1];
        const std::uint64_t row = prefix | spread_bits(y) << 1 | spread_bits(z) << 2;
        std::uint64_t x_bits = own_row ? next_spread(spread_bits((*own)[0])) : first_x;
        for (std::uint32_t x = own_row ? (*own)[0] + 1 : window.low[0]; x <= window.high[0]; ++x) {
          add_run(row | x_bits, runs);
          x_bits = next_spread(x_bits);
        }
      }
    }
  }

  // How many cells that looks up.
  static std::size_t cells_of_runs(const Window& window, const CellNumbers* own) {
    const std::size_t row = window.high[0] + 1 - window.low[0];
    const std::size_t slab = row * (window.high[1] + 1 - window.low[1]);
    if (own == nullptr) return slab * (window.high[2] + 1 - window.low[2]);
    return (window.high[0] - (*own)[0]) + row * (window.high[1] - (*own)[1]) +
           slab * (window.high[2] - (*own)[2]);
  }

  void add_run(std::uint64_t cell, std::vector<IndexRange>& runs) const {
    const std::size_t bit = filter_bit(cell);
    if ((filter_[bit / 64] >> bit % 64 & 1) == 0) return;
    const Cell& found = table_[slot(cell)];
    if (found.cell == no_cell) return;
    if (!runs.empty() && runs.back().last == found.first) {
      runs.back().last = found.last;
    } else {
      runs.push_back({found.first, found.last});
    }
  }

  Executor& executor_;
  std::vector<std::uint32_t> ids_;
  CellSpace space_;               // the finest level's cells
  std::array<double, 3> side_{};  // of a finest cell: metres
  int top_ = 0;                   // the coarsest level
  unsigned levels_ = 0;           // bit l: there are boxes at level l
  std::vector<Item> items_;
  RadixSort<Item> radix_sort_;
  BoxArrays arrays_;
  std::vector<Cell> cells_;  // in the boxes' order
  std::vector<Cell> table_;
  int table_bits_ = 0;
  std::vector<std::uint64_t> filter_;
  std::vector<Scratch> scratch_;  // of each worker
};

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {{.info = {.name = "loose-octree",
                    .citation = "Ulrich, \"Loose Octrees\", Game Programming Gems, 2000; "
                                "Gargantini, CACM 1982 (linear)"},
           .make = [](touchstone::Executor& executor) {
             return std::make_unique<touchstone::LooseOctree>(executor);
           }}};
}
