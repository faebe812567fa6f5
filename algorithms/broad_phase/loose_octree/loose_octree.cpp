// Loose octree: each box lies in one cell, at the level of its size, and may reach beyond it; cells
// whose bounds overlap are joined from the root down, and boxes in cells of at most sixteen.
// Paper:   Ulrich, "Loose Octrees", Game Programming Gems, 2000; Gargantini, "An Effective Way to
//          Represent Quadtrees", CACM 1982 (linear: sorted codes).
// Steps:   1. Give each box the cell that contains its centre, at the level of its size, and
//             radix-sort the cells' Morton codes (octree_order.cpp).
//          2. Divide the sorted range into the root's octants and these in turn, down to leaves of
//             at most 16 boxes; join small octants, and skip cells with a single part.
//          3. If many boxes share one key, sort them by an octree of their own.
//          4. Bound each leaf by its boxes and each cell by its parts, from the bottom up.
//          5. Descend from the root; pass each cell the list of later cells that overlap it, and
//             pick from the list, and from these cells' parts, what overlaps each part
//             (tree_self_join.inl).
//          6. In a leaf test its boxes against each other and against boxes of the listed leaves
//             that overlap its bounds, a vector at a time.
//          7. Each cell of at most 2048 boxes is a task.
// Departs: the looseness of a cell follows its boxes: its bounds are theirs. Cells have the
//          proportions of the usual box. A cell with at most sixteen boxes is not divided, small
//          adjacent parts become one, and of a chain of cells with a single part only the last is
//          kept. If many boxes lie in one finest cell, or are large for the cell that they share,
//          they get an octree of their own.
// Fails:   long thin boxes in all directions: the bounds of all cells overlap.
// Cost:    O(n) time for keys and sort, O(n log n + k) expected for the search; k = pairs that
//          overlap. About 60 bytes a body.
#include <algorithm>
#include <array>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/loose_octree/octree_order.h"
#include "algorithms/broad_phase/loose_octree/tree_self_join.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/group_scan.h"
#include "algorithms/kernels/boxes/structure_boxes.h"

namespace touchstone {
namespace {

class LooseOctree final : public BroadPhase {
 public:
  explicit LooseOctree(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    status_ = ids_.size() < NodeRef::most_begins ? Status::ok : Status::capacity;
    if (status_ != Status::ok) ids_.clear();
    order_.sort(executor_, boxes, ids_);
    grow(boxes);
    boxes_.gather(executor_, boxes, order_.size(), [&](std::size_t i) { return order_.id(i); });
    fit();
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    sink.start(tasks_.size());
    const auto task = [&](std::size_t i, int worker) {
      join_block(tree_, boxes_, tasks_[i].block, tasks_[i].part,
                 scratch_[static_cast<std::size_t>(worker)], sink.chunk(i));
    };
    executor_.run(tasks_.size(), std::cref(task));
    return status_;
  }

  BroadPhaseWork work() const override {
    JoinScratch scratch;
    PairBuffer pairs;
    for (const Task& task : tasks_) {
      pairs.clear();
      join_block(tree_, boxes_, task.block, task.part, scratch, pairs);
    }
    scratch.work.bytes = sum_held_bytes(ids_, order_, boxes_, cells_, refs_, tree_, tasks_);
    return scratch.work;
  }

  std::vector<StructureBox> structure() const override;

 private:
  static constexpr std::uint32_t fan = NodeRef::fan;
  // The subtree of a cell with at most this many boxes is one task.
  static constexpr std::uint32_t boxes_a_task = 2048;

  static constexpr NodeRef no_node{0};  // an inner node, and below the root

  // A range of more boxes than a leaf may have. Its parts are a block of the tree's nodes.
  struct Cell {
    std::uint32_t first, last;
  };
  struct Parts {
    std::array<std::uint32_t, fan> ends;  // each part begins at the end of the one before
    std::uint32_t count = 0;
  };
  struct Task {
    std::uint32_t block;
    JoinPart part;
  };

  void grow(std::span<const Aabb> boxes);
  Parts divide(std::span<const Aabb> boxes, std::uint32_t first, std::uint32_t last);
  static Parts divide_evenly(std::uint32_t first, std::uint32_t last);
  void list_tasks();
  void fit();

  Executor& executor_;
  std::vector<JoinScratch> scratch_;
  std::vector<std::uint32_t> ids_;
  OctreeOrder order_;
  AabbSoA boxes_;  // sorted as in the octree
  std::vector<Cell> cells_;
  std::vector<NodeRef> refs_;  // one for each node of the tree
  JoinTree tree_;
  std::vector<Task> tasks_;
  Status status_ = Status::ok;
};

// Builds the cells breadth first, so that parents precede their parts.
void LooseOctree::grow(std::span<const Aabb> boxes) {
  cells_.clear();
  refs_.clear();
  tree_.parent.clear();
  const auto count = static_cast<std::uint32_t>(order_.size());
  if (count > 0) {
    cells_.push_back({0, count});
    tree_.parent.push_back(0);
  }
  for (std::size_t block = 0; block < cells_.size(); ++block) {
    const Cell cell = cells_[block];
    const Parts parts = divide(boxes, cell.first, cell.last);
    if (block > 0) {
      refs_[tree_.parent[block]] = NodeRef::inner(static_cast<std::uint32_t>(block), parts.count);
    }
    std::uint32_t first = cell.first;
    for (std::uint32_t part = 0; part < parts.count; ++part) {
      const std::uint32_t last = parts.ends[part];
      if (last - first <= fan) {
        refs_.push_back(NodeRef::leaf(first, last - first));
      } else {
        cells_.push_back({first, last});
        tree_.parent.push_back(static_cast<std::uint32_t>(refs_.size()));
        refs_.push_back({});
      }
      first = last;
    }
    refs_.resize((block + 1) * fan, no_node);
  }
  list_tasks();
}

void LooseOctree::list_tasks() {
  const auto is_large = [&](std::size_t block) {
    return cells_[block].last - cells_[block].first > boxes_a_task;
  };
  tasks_.clear();
  for (std::uint32_t block = 0; block < cells_.size(); ++block) {
    if (is_large(block)) {
      tasks_.push_back({block, JoinPart::leaves});
    } else if (block == 0 || is_large(tree_.parent[block] / fan)) {
      tasks_.push_back({block, JoinPart::all});
    }
  }
}

// Divides a range into two parts or more if it has more boxes than a leaf may have.
LooseOctree::Parts LooseOctree::divide(std::span<const Aabb> boxes, std::uint32_t first,
                                       std::uint32_t last) {
  if (last - first <= fan) return divide_evenly(first, last);
  while (order_.key(first) == order_.key(last - 1)) {
    if (!order_.refine(executor_, boxes, first, last)) return divide_evenly(first, last);
  }
  Parts parts;
  const std::uint32_t key = order_.key(first);
  const int depth = OctreeOrder::common_levels(key, order_.key(last - 1));
  // The first part is boxes too large for an octant; in a finest cell, those of the largest size.
  const int own_depth = depth < OctreeOrder::most_levels ? depth : OctreeOrder::depth(key);
  std::uint32_t end = first;
  while (OctreeOrder::depth(order_.key(end)) <= own_depth) ++end;
  if (end > first) parts.ends[parts.count++] = end;
  if (depth == OctreeOrder::most_levels) {
    parts.ends[parts.count++] = last;
    return parts;
  }
  const std::uint32_t own_parts = parts.count;
  std::uint32_t begin = end;  // first box of the part before
  while (end < last) {
    const std::uint32_t octant = OctreeOrder::octant(order_.key(end), depth);
    const std::uint32_t from = end;
    std::uint32_t behind = last;
    while (end + 1 < behind) {
      const std::uint32_t middle = end + (behind - end) / 2;
      (OctreeOrder::octant(order_.key(middle), depth) == octant ? end : behind) = middle;
    }
    end = behind;
    // A small octant joins the part before it.
    if (parts.count > own_parts && end - begin <= fan) {
      --parts.count;
    } else {
      begin = from;
    }
    parts.ends[parts.count++] = end;
  }
  return parts;
}

LooseOctree::Parts LooseOctree::divide_evenly(std::uint32_t first, std::uint32_t last) {
  Parts parts;
  std::uint32_t size = fan;
  while (size * fan < last - first) size *= fan;
  while (first < last) parts.ends[parts.count++] = first = std::min(first + size, last);
  return parts;
}

void LooseOctree::fit() {
  AabbSoA& nodes = tree_.nodes;
  nodes.resize(refs_.size());
  for_each_block(
      executor_, refs_.size(), 512, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const NodeRef ref = refs_[i];
          const Aabb bounds = ref.is_leaf()
                                  ? bounds_of(boxes_, {ref.begin(), ref.begin() + ref.count()})
                                  : Aabb::empty();
          nodes.set(i, bounds, ref.packed);
        }
      });
  for (std::size_t block = cells_.size(); block-- > 1;) {
    const std::size_t node = tree_.parent[block];
    nodes.set(node, bounds_of(nodes, {block * fan, block * fan + fan}), refs_[node].packed);
  }
}

// Shows the loose boxes, the bounds of a cell's bodies, since the search uses no others. The root
// has none of its own, because the search starts at its parts; it is shown with the bounds of all.
std::vector<StructureBox> LooseOctree::structure() const {
  if (cells_.empty()) return {};
  std::vector<StructureBox> nodes{{bounds_of(boxes_, {0, boxes_.size()}), 0}};
  std::vector<std::uint32_t> depths(cells_.size(), 1);  // of the nodes of each block
  for (std::size_t block = 1; block < cells_.size(); ++block) {
    depths[block] = depths[tree_.parent[block] / fan] + 1;
  }
  const std::vector<Aabb> boxes = list_boxes(tree_.nodes);
  for (std::size_t node = 0; node < boxes.size(); ++node) {
    if (!boxes[node].is_empty()) nodes.push_back({boxes[node], depths[node / fan]});
  }
  return nodes;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_loose_octree() {
  return {{.info = {.name = "loose-octree",
                    .citation = "Ulrich, \"Loose Octrees\", Game Programming Gems, 2000; "
                                "Gargantini, CACM 1982 (linear); cells against cells"},
           .make = [](Executor& executor) { return std::make_unique<LooseOctree>(executor); }}};
}

}  // namespace touchstone::entries
