// Hierarchical grid: a grid for each size class; each box lies in one cell of its class's grid, and
// is tested against the boxes in the cells around it there and in the coarser grids.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 7.2; Mirtich, "Impulse-based
//          Dynamic Simulation of Rigid Body Systems", thesis, Berkeley 1996 (the hash of grids).
// Steps:   1. Form classes of at least 64 boxes by the exponent of the longest side
//             (magnitude_histogram.cpp).
//          2. Give each class a grid whose cells are at least as long as its boxes; number its
//             cells in serpentine order (serpentine_grid.h).
//          3. Radix-sort the boxes by class and cell; give dense cells a grid of their own, and
//             index the sorted cells (grid_levels.cpp).
//          4. Cut each grid's boxes into groups of 16 neighbours, and bound each group.
//          5. For each group, and each grid of its class and above that reaches its bounds, list
//             the runs of boxes in the cells that could overlap them. Take only boxes after the
//             group.
//          6. Test the group against these runs (kernels/boxes/group_scan.h).
// Departs: there is no hash and there are no linked lists: boxes are sorted by cell, so adjacent
//          cells are one run of boxes, which an index finds. 16 neighbouring boxes search together.
//          Cells are as large as the class's largest box, or larger where bodies are sparse: about
//          16 boxes then lie in a cube of cells. A box is tested against later ones only, so each
//          pair of cells is visited once.
// Fails:   long thin boxes in all directions: a cell is as long as they are, on each axis.
// Cost:    O(n) for keys and sort, O(n l + k) expected; l = grids in use, k = pairs in neighbouring
//          cells. About 65 bytes a body.
#include <algorithm>
#include <functional>
#include <set>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/hierarchical_grid/grid_levels.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_measure.h"
#include "algorithms/kernels/boxes/group_scan.h"
#include "algorithms/kernels/boxes/structure_boxes.h"

namespace touchstone {
namespace {

class HierarchicalGrid final : public BroadPhase {
 public:
  explicit HierarchicalGrid(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    grids_.sort(executor_, boxes, ids_, group_size);
    boxes_.gather(executor_, boxes, grids_.size(), [&](std::size_t i) { return grids_.id(i); });
    groups_ = 0;
    first_group_.clear();
    for (const Level& level : grids_.levels()) {
      first_group_.push_back(groups_);
      groups_ += block_count(level.boxes.last - level.boxes.first, group_size);
    }
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    search_groups(executor_, groups_, groups_a_task, scratch_, sink,
                  std::bind_front(&HierarchicalGrid::pair_group, this));
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    Scratch scratch;
    count_groups(groups_, scratch, std::bind_front(&HierarchicalGrid::pair_group, this));
    scratch.group.work.bytes = sum_held_bytes(ids_, grids_, boxes_, first_group_);
    return scratch.group.work;
  }

  std::vector<StructureBox> structure() const override;

 private:
  using Level = GridLevels::Level;
  static constexpr std::size_t groups_a_task = 32;

  struct Scratch {
    std::vector<IndexRange> partners;
    GroupScratch group;
  };

  void pair_group(std::size_t group, Scratch& scratch, PairBuffer& out) const;
  void find_partners(const Level& level, const Aabb& bounds, std::size_t from,
                     Scratch& scratch) const;

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  GridLevels grids_;
  AabbSoA boxes_;                         // sorted as in the levels
  std::vector<std::size_t> first_group_;  // number of each level's first group
  std::size_t groups_ = 0;
};

void HierarchicalGrid::pair_group(std::size_t group, Scratch& scratch, PairBuffer& out) const {
  // The group's level is the last that begins at it or before; empty levels begin where the next
  // does.
  const std::size_t own = static_cast<std::size_t>(std::ranges::upper_bound(first_group_, group) -
                                                   first_group_.begin()) -
                          1;
  const auto levels = grids_.levels();
  const std::size_t first = levels[own].boxes.first + (group - first_group_[own]) * group_size;
  const IndexRange members{first, std::min(first + group_size, levels[own].boxes.last)};
  const Aabb bounds = bounds_of(boxes_, members);
  scratch.partners.clear();
  for (const Level& level : levels.subspan(own)) {
    if (overlap(level.bounds, bounds)) find_partners(level, bounds, members.last, scratch);
  }
  scan_group(boxes_, members, bounds, scratch.partners, scratch.group, out);
}

// Lists the boxes from `from` on in the level's cells that may hold boxes that overlap the bounds.
void HierarchicalGrid::find_partners(const Level& level, const Aabb& bounds, std::size_t from,
                                     Scratch& scratch) const {
  if (from >= level.boxes.last) return;
  const SerpentineGrid::Window window = level.grid.window(bounds);
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
  // If there are more rows than boxes, all boxes of these slabs are one run.
  const std::size_t left = level.boxes.last - std::max(from, level.boxes.first);
  if (window.rows() * window.slabs() * 4 > left) {
    return add({grids_.find(level, level.grid.first_cell_of_slab(window.low[2])),
                grids_.find(level, level.grid.first_cell_of_slab(window.high[2] + 1))});
  }
  const std::uint64_t own_cell = from > level.boxes.first ? grids_.cell(level, from) : 0;
  for (std::size_t slab = window.low[2]; slab <= window.high[2]; ++slab) {
    for (std::size_t row = window.low[1]; row <= window.high[1]; ++row) {
      const std::uint64_t first = level.grid.first_cell(window, row, slab);
      const std::uint64_t end = first + window.length();
      if (end > own_cell) add({grids_.find(level, first), grids_.find(level, end)});
    }
  }
}

// Shows the cells with bodies, each as the box of the minimum corners in it: a body may reach beyond
// it. The level is the rank of the cells' longest side; dense cells' grids of one size share it.
std::vector<StructureBox> HierarchicalGrid::structure() const {
  std::set<double, std::greater<>> sides;
  for (const Level& level : grids_.levels()) {
    if (level.boxes.first < level.boxes.last) sides.insert(level.grid.side());
  }
  const Aabb scene = bounds_of(list_boxes(boxes_));
  std::vector<StructureBox> cells;
  for (const Level& level : grids_.levels()) {
    const auto rank = std::distance(sides.begin(), sides.find(level.grid.side()));
    const Aabb& region = contains(scene, level.bounds) ? level.bounds : scene;
    for (std::size_t i = level.boxes.first; i < level.boxes.last; ++i) {
      const std::uint64_t cell = grids_.cell(level, i);
      if (i > level.boxes.first && cell == grids_.cell(level, i - 1)) continue;
      cells.push_back({level.grid.box_of(cell, region), static_cast<std::uint32_t>(rank)});
    }
  }
  return cells;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_hierarchical_grid() {
  return {
      {.info = {.name = "hierarchical-grid",
                .citation = "Ericson, Real-Time Collision Detection, 2005, section 7.2; "
                            "Mirtich, thesis, Berkeley 1996; sorted cells"},
       .make = [](Executor& executor) { return std::make_unique<HierarchicalGrid>(executor); }}};
}

}  // namespace touchstone::entries
