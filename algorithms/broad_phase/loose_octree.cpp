// Loose octree: each box lies in one cell, at the level of its size, and reaches beyond it; cells
// that overlap are paired from the root down, and boxes where no cell has more than sixteen.
// Paper:   Ulrich, "Loose Octrees", Game Programming Gems, 2000; Gargantini, "An Effective Way to
//          Represent Quadtrees", CACM 1982 (linear: sorted codes).
// Departs: a cell is as loose as its boxes make it: its bounds are those of what lies in it. Cells
//          have the proportions of the usual box. A cell ends where sixteen boxes are left, few
//          parts side by side are one, and of cells with a single part only the last is kept. Where
//          many boxes lie in one finest cell, or are large for the cell where they are, they get an
//          octree of their own. Each cell is handed a list of those behind it that it overlaps, and
//          picks from it what its parts overlap, a vector at a time.
// Fails:   long thin boxes in all directions: the bounds of all cells overlap.
// Cost:    O(n) time for keys and sort, O(n log n + k) to be expected for the search; k = pairs
// that
//          overlap. About 60 bytes a body.
#include <algorithm>
#include <array>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_list.h"
#include "algorithms/kernels/group_scan.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/octree_order.h"

namespace touchstone {
namespace {

class LooseOctree final : public BroadPhase {
 public:
  explicit LooseOctree(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    order_.sort(executor_, boxes, ids_);
    grow(boxes);
    boxes_.gather(executor_, boxes, order_.size(), [&](std::size_t i) { return order_.id(i); });
    fit();
  }

  void update(const FrameChange& change) override { build(change.boxes); }

  Status find_pairs(PairSink& sink) override {
    sink.start(tasks_.size());
    const auto task = [&](std::size_t i, int worker) {
      search_from_root(tasks_[i], scratch_[static_cast<std::size_t>(worker)], sink.chunk(i));
    };
    executor_.run(tasks_.size(), std::cref(task));
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    Scratch scratch;
    PairBuffer pairs;
    for (const std::uint32_t task : tasks_) {
      pairs.clear();
      search_from_root(task, scratch, pairs);
    }
    scratch.group.work.bytes = sum_held_bytes(ids_, order_, boxes_, nodes_, bounds_, tasks_);
    return scratch.group.work;
  }

 private:
  static constexpr std::uint32_t most_parts = 16;  // of a node
  // A node of no more is the work of one task, with all that is below it.
  static constexpr std::uint32_t boxes_a_task = 2048;
  static constexpr int count_bits = 4;
  static constexpr std::uint32_t count_mask = (1u << count_bits) - 1;

  // Boxes of a cell, one behind the other.
  struct Node {
    std::uint32_t first, last;
    // The nodes below: two or more one behind the other. A leaf stands for itself.
    std::uint32_t below, count, parent;
    bool is_leaf() const { return count == 1; }
  };
  struct Scratch {
    BoxList list;
    std::vector<IndexRange> partners;
    GroupScratch group;
  };
  struct Parts {
    std::array<std::uint32_t, most_parts + 1> ends;  // the first one's beginning comes before
    std::uint32_t count = 0;
  };

  void grow(std::span<const Aabb> boxes);
  Parts divide(std::span<const Aabb> boxes, std::uint32_t first, std::uint32_t last);
  static Parts divide_evenly(std::uint32_t first, std::uint32_t last);
  void fit();
  Aabb bounds(std::size_t node) const {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.min[static_cast<std::size_t>(axis)] = bounds_.min(axis)[node];
      box.max[static_cast<std::size_t>(axis)] = bounds_.max(axis)[node];
    }
    return box;
  }
  static IndexRange nodes_below(std::uint32_t listed) {
    const std::size_t first = listed >> count_bits;
    return {first, first + (listed & count_mask) + 1};
  }
  static bool is_leaf(std::uint32_t listed) { return (listed & count_mask) == 0; }

  IndexRange list_parts(std::size_t node, IndexRange list, Scratch& scratch) const;
  void search_from_root(std::uint32_t task, Scratch& scratch, PairBuffer& out) const;
  IndexRange list_from_root(std::uint32_t node, Scratch& scratch) const;
  void search(std::size_t node, IndexRange list, Scratch& scratch, PairBuffer& out) const;
  void list_leaves(const Aabb& bound, IndexRange list, Scratch& scratch) const;
  void append(const Aabb& bound, IndexRange nodes, Scratch& scratch) const {
    scratch.list.append(bound, bounds_, nodes);
    ++scratch.group.work.node_visits;
    scratch.group.work.box_tests += static_cast<std::int64_t>(nodes.last - nodes.first);
  }

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  OctreeOrder order_;
  BoxArrays boxes_;          // in that order
  std::vector<Node> nodes_;  // parents come first
  BoxArrays bounds_;  // of the nodes; ids: the place of the nodes below, and how many more than one
  std::vector<std::uint32_t> tasks_;
};

// Breadth first.
void LooseOctree::grow(std::span<const Aabb> boxes) {
  nodes_.clear();
  tasks_.clear();
  const auto count = static_cast<std::uint32_t>(order_.size());
  if (count == 0) return;
  nodes_.push_back({0, count, 0, 1, 0});
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const Node node = nodes_[i];
    if (node.last - node.first <= group_size) continue;
    const Parts parts = divide(boxes, node.first, node.last);
    nodes_[i].below = static_cast<std::uint32_t>(nodes_.size());
    nodes_[i].count = parts.count;
    std::uint32_t first = node.first;
    for (std::uint32_t part = 0; part < parts.count; ++part) {
      const auto own = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({first, parts.ends[part], own, 1, i});
      first = parts.ends[part];
    }
  }
  const auto is_small = [&](const Node& node) { return node.last - node.first <= boxes_a_task; };
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (is_small(nodes_[i]) && (i == 0 || !is_small(nodes_[nodes_[i].parent]))) {
      tasks_.push_back(i);
    }
  }
}

// More than a leaf may have, into two parts or more.
LooseOctree::Parts LooseOctree::divide(std::span<const Aabb> boxes, std::uint32_t first,
                                       std::uint32_t last) {
  while (order_.key(first) == order_.key(last - 1)) {
    if (!order_.refine(executor_, boxes, first, last)) return divide_evenly(first, last);
  }
  Parts parts;
  const std::uint32_t key = order_.key(first);
  const int depth = OctreeOrder::common_levels(key, order_.key(last - 1));
  // Those that are too large for a part; of one cell, those of the largest size.
  const int own_depth = depth < OctreeOrder::most_levels ? depth : OctreeOrder::depth(key);
  std::uint32_t end = first;
  while (OctreeOrder::depth(order_.key(end)) <= own_depth) ++end;
  if (end > first) parts.ends[parts.count++] = end;
  if (depth == OctreeOrder::most_levels) {
    parts.ends[parts.count++] = last;
    return parts;
  }
  const std::uint32_t own_parts = parts.count;
  std::uint32_t begin = end;  // of the part before
  while (end < last) {
    const std::uint32_t octant = OctreeOrder::octant(order_.key(end), depth);
    const std::uint32_t from = end;
    std::uint32_t behind = last;
    while (end + 1 < behind) {
      const std::uint32_t middle = end + (behind - end) / 2;
      (OctreeOrder::octant(order_.key(middle), depth) == octant ? end : behind) = middle;
    }
    end = behind;
    if (parts.count > own_parts && end - begin <= group_size)
      --parts.count;
    else
      begin = from;
    parts.ends[parts.count++] = end;
  }
  return parts;
}

LooseOctree::Parts LooseOctree::divide_evenly(std::uint32_t first, std::uint32_t last) {
  Parts parts;
  std::uint32_t size = group_size;
  while (size * most_parts < last - first) size *= most_parts;
  while (first < last) parts.ends[parts.count++] = first = std::min(first + size, last);
  return parts;
}

void LooseOctree::fit() {
  bounds_.resize(nodes_.size());
  for_each_block(executor_, nodes_.size(), 256,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const Node& node = nodes_[i];
                     if (!node.is_leaf()) continue;
                     bounds_.set(i, bounds_of(boxes_, {node.first, node.last}),
                                 static_cast<std::uint32_t>(i) << count_bits);
                   }
                 });
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (node.is_leaf()) continue;
    bounds_.set(i, bounds_of(bounds_, {node.below, node.below + node.count}),
                node.below << count_bits | (node.count - 1));
  }
}

void LooseOctree::search_from_root(std::uint32_t task, Scratch& scratch, PairBuffer& out) const {
  const std::size_t first = scratch.list.start();
  search(task, list_from_root(task, scratch), scratch, out);
  scratch.list.drop(first);
}

// The nodes behind this one that it overlaps; of those above the tasks each is gone through once
// more for each task below it.
IndexRange LooseOctree::list_from_root(std::uint32_t node, Scratch& scratch) const {
  if (node == 0) return {scratch.list.end(), scratch.list.end()};
  const Node& parent = nodes_[nodes_[node].parent];
  const IndexRange above = list_from_root(nodes_[node].parent, scratch);
  const IndexRange parts = list_parts(nodes_[node].parent, above, scratch);
  const std::size_t first = scratch.list.start();
  scratch.list.append(bounds(node), {parts.first + (node - parent.below) + 1, parts.last});
  return {first, scratch.list.end()};
}

// The parts of a node, and of those in the list what it overlaps.
IndexRange LooseOctree::list_parts(std::size_t node, IndexRange list, Scratch& scratch) const {
  const std::size_t first = scratch.list.start();
  const Aabb bound = bounds(node);
  append(bound, nodes_below(bounds_.ids()[node]), scratch);
  for (std::size_t i = list.first; i < list.last; ++i) {
    append(bound, nodes_below(scratch.list.ids()[i]), scratch);
  }
  return {first, scratch.list.end()};
}

// The list: the nodes behind this one that it overlaps.
void LooseOctree::search(std::size_t node, IndexRange list, Scratch& scratch,
                         PairBuffer& out) const {
  const Node& own = nodes_[node];
  if (own.is_leaf()) {
    scratch.partners.clear();
    const Aabb bound = bounds(node);
    list_leaves(bound, list, scratch);
    scan_group(boxes_, {own.first, own.last}, bound, scratch.partners, scratch.group, out);
    return;
  }
  const IndexRange parts = list_parts(node, list, scratch);
  for (std::size_t part = own.below; part < own.below + own.count; ++part) {
    const std::size_t first = scratch.list.start();
    const std::size_t behind = parts.first + (part - own.below) + 1;
    scratch.list.append(bounds(part), {behind, parts.last});
    scratch.group.work.box_tests += static_cast<std::int64_t>(parts.last - behind);
    search(part, {first, scratch.list.end()}, scratch, out);
    scratch.list.drop(first);
  }
  scratch.list.drop(parts.first);
}

// The boxes of the leaves among the nodes of the list, and below them, that overlap the bound.
void LooseOctree::list_leaves(const Aabb& bound, IndexRange list, Scratch& scratch) const {
  for (std::size_t i = list.first; i < list.last; ++i) {
    const std::uint32_t listed = scratch.list.ids()[i];
    if (is_leaf(listed)) {
      const Node& leaf = nodes_[listed >> count_bits];
      auto& partners = scratch.partners;
      if (!partners.empty() && partners.back().last == leaf.first) {
        partners.back().last = leaf.last;
      } else {
        partners.push_back({leaf.first, leaf.last});
      }
      continue;
    }
    const std::size_t first = scratch.list.start();
    append(bound, nodes_below(listed), scratch);
    list_leaves(bound, {first, scratch.list.end()}, scratch);
    scratch.list.drop(first);
  }
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {{.info = {.name = "loose-octree",
                    .citation = "Ulrich, \"Loose Octrees\", Game Programming Gems, 2000; "
                                "Gargantini, CACM 1982 (linear); cells against cells"},
           .make = [](touchstone::Executor& executor) {
             return std::make_unique<touchstone::LooseOctree>(executor);
           }}};
}
