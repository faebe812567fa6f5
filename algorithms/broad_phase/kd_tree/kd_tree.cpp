// kd-tree over bodies stored in the order of its nodes: boxes of one half that reach into the other
// are passed down as a list, and leaves are tested a vector at a time.
// Paper:   Serpa, Rodrigues, "Flexible Use of Temporal and Spatial Reasoning for Fast and Scalable
//          CPU Broad-Phase Collision Detection Using KD-Trees", Computer Graphics Forum 2019.
// Steps:   1. Split the bodies by their centres down to leaves of 32; the few that are larger than
//             half of a node's cell stay at the node (kd_bodies.cpp).
//          2. Compute the bounds of each node from its bodies and its children (kd_nodes.cpp).
//          3. In an update keep the tree and repeat step 2; start at step 1 when the bounds of the
//             leaves have grown by a quarter, or bodies come or go.
//          4. Descend from the root with a list: the bodies of earlier nodes that overlap the
//             node's bounds.
//          5. At each node test its own bodies against each other and the list.
//          6. For each child keep of the list, and of the node's own bodies, what overlaps the
//             child's bounds. For the right child add what overlaps it from the left child's
//             subtree.
//          7. Each node of at most 2048 bodies is a task, which gathers its list along its
//             ancestors.
// Departs: bodies are split by their centres and each node has the bounds of its bodies, so only
//          bodies that are large for a node stay at it; if all that straddle the plane stayed, most
//          of a uniform scene would. kd_bodies.h says where the plane is. While bodies move a
//          little the tree is kept.
// Fails:   long thin boxes in all directions: the bounds of all nodes overlap, and each leaf is
//          tested against all bodies before it.
// Cost:    O(n log n) time, O(n log n + k) expected for the search; k = pairs that overlap. About
//          100 bytes a body.
#include <algorithm>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/kd_tree/kd_nodes.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_stack.h"

namespace touchstone {
namespace {

class KdTree final : public BroadPhase {
 public:
  explicit KdTree(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    nodes_.build(executor_, boxes, ids_);
    list_tasks();
    spread_ = nodes_.spread();
  }

  void update(const FrameChange& change) override {
    if (!change.inserted.empty() || !change.removed.empty()) return build(change.boxes);
    if (change.moved.empty()) return;
    nodes_.update(executor_, change.boxes);
    // The negation makes a NaN, from bounds that overflow, rebuild the tree.
    if (!(nodes_.spread() <= 1.25 * spread_)) build(change.boxes);
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(tasks_.size());
    const auto task = [&](std::size_t i, int worker) {
      search(tasks_[i], scratch_[static_cast<std::size_t>(worker)], sink.chunk(i));
    };
    executor_.run(tasks_.size(), std::cref(task));
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    Scratch scratch;
    PairBuffer pairs;
    for (const Task& task : tasks_) {
      pairs.clear();
      search(task, scratch, pairs);
    }
    scratch.work.bytes = sum_held_bytes(ids_, nodes_, tasks_);
    return scratch.work;
  }

  // The nodes with their depths.
  std::vector<StructureBox> structure() const override {
    std::vector<StructureBox> nodes;
    if (!nodes_.tops().empty()) show(nodes_[nodes_.node_of_top(0)], 0, nodes);
    return nodes;
  }

 private:
  static constexpr std::uint32_t rows_a_task = 512;
  // A subtree of at most this many bodies is searched as one array, not node by node.
  static constexpr std::uint32_t collected_at_once = 256;

  // The search for partners of `rows`, which are bodies of a top node's own, and of all bodies
  // below the node if `whole`.
  struct Task {
    std::uint32_t top;
    IndexRange rows;
    bool whole;
  };
  struct Scratch {
    AabbStack list;
    BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
  };

  void list_tasks();
  void search(const Task& task, Scratch& scratch, PairBuffer& out) const;
  void search(const KdNode& node, IndexRange list, Scratch& scratch, PairBuffer& out) const;
  void pair(const KdNode& node, IndexRange rows, IndexRange list, Scratch& s,
            PairBuffer& out) const;
  void collect(const KdNode& from, const Aabb& bound, Scratch& scratch) const;
  void take(IndexRange range, const Aabb& bound, Scratch& scratch) const;
  void show(const KdNode& node, std::uint32_t depth, std::vector<StructureBox>& nodes) const;

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  KdNodes nodes_;
  std::vector<Task> tasks_;
  double spread_ = 0;
};

// Cuts the own bodies of a node into several tasks if they are many: large ones, or ones in one
// place.
void KdTree::list_tasks() {
  tasks_.clear();
  for (std::uint32_t i = 0; i < nodes_.tops().size(); ++i) {
    const KdNode& node = nodes_[nodes_.node_of_top(i)];
    const bool whole = nodes_.tops()[i].is_whole() && !node.is_leaf();
    if (whole) {
      tasks_.push_back({i, {node.first, node.own_end}, true});
      continue;
    }
    for (std::uint32_t row = node.first; row < node.own_end; row += rows_a_task) {
      tasks_.push_back({i, {row, std::min(row + rows_a_task, node.own_end)}, false});
    }
  }
}

// Searches for a task. Each task goes through the nodes before its top node again.
void KdTree::search(const Task& task, Scratch& scratch, PairBuffer& out) const {
  const KdNode& node = nodes_[nodes_.node_of_top(task.top)];
  const std::size_t first = scratch.list.start();
  for (std::uint32_t i = task.top; nodes_.tops()[i].parent != KdNode::none;
       i = nodes_.tops()[i].parent) {
    const KdNode& parent = nodes_[nodes_.node_of_top(nodes_.tops()[i].parent)];
    take({parent.first, parent.own_end}, node.bounds, scratch);
    if (nodes_.node_of_top(i) != parent.left) collect(nodes_[parent.left], node.bounds, scratch);
  }
  const IndexRange list{first, scratch.list.end()};
  if (task.whole) {
    search(node, list, scratch, out);
  } else {
    pair(node, task.rows, list, scratch, out);
  }
  scratch.list.drop(first);
}

// `list` holds all bodies before the node's own that could overlap one of them.
void KdTree::search(const KdNode& node, IndexRange list, Scratch& scratch, PairBuffer& out) const {
  pair(node, {node.first, node.own_end}, list, scratch, out);
  if (node.is_leaf()) return;
  for (std::uint32_t child = node.left; child < node.left + 2; ++child) {
    const Aabb& bounds = nodes_[child].bounds;
    const std::size_t first = scratch.list.start();
    scratch.list.append(bounds, list);
    scratch.work.box_tests += static_cast<std::int64_t>(list.last - list.first);
    take({node.first, node.own_end}, bounds, scratch);
    if (child != node.left) collect(nodes_[node.left], bounds, scratch);
    search(nodes_[child], {first, scratch.list.end()}, scratch, out);
    scratch.list.drop(first);
  }
}

void KdTree::pair(const KdNode& node, IndexRange rows, IndexRange list, Scratch& scratch,
                  PairBuffer& out) const {
  ++scratch.work.node_visits;
  if (rows.first == rows.last) return;
  pair_rows(nodes_.boxes(), rows, node.own_end, scratch.list, list, out);
  const std::size_t behind = node.own_end - rows.first - 1 + (node.own_end - rows.last);
  const std::size_t tests =
      (rows.last - rows.first) * (list.last - list.first) + (rows.last - rows.first) * behind / 2;
  scratch.work.box_tests += static_cast<std::int64_t>(tests);
  scratch.work.candidates += static_cast<std::int64_t>(tests);
}

void KdTree::take(IndexRange range, const Aabb& bound, Scratch& scratch) const {
  if (range.first == range.last) return;
  scratch.list.append(bound, nodes_.boxes(), range);
  scratch.work.box_tests += static_cast<std::int64_t>(range.last - range.first);
}

// Appends the bodies of the node's subtree that overlap `bound`.
void KdTree::collect(const KdNode& from, const Aabb& bound, Scratch& scratch) const {
  ++scratch.work.node_visits;
  ++scratch.work.box_tests;
  if (!overlap(from.bounds, bound)) return;
  if (from.is_leaf() || from.last - from.first <= collected_at_once) {
    return take({from.first, from.last}, bound, scratch);
  }
  take({from.first, from.own_end}, bound, scratch);
  collect(nodes_[from.left], bound, scratch);
  collect(nodes_[from.left + 1], bound, scratch);
}

// Lists the node and all nodes below it.
void KdTree::show(const KdNode& node, std::uint32_t depth, std::vector<StructureBox>& nodes) const {
  nodes.push_back({node.bounds, depth});
  if (node.is_leaf()) return;
  show(nodes_[node.left], depth + 1, nodes);
  show(nodes_[node.left + 1], depth + 1, nodes);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_kd_tree() {
  return {
      {.info = {.name = "kd-tree",
                .citation = "Serpa, Rodrigues, \"Flexible Use of Temporal and Spatial Reasoning "
                            "... Using KD-Trees\", Computer Graphics Forum 2019; split by "
                            "centres, with bounds"},
       .make = [](Executor& executor) { return std::make_unique<KdTree>(executor); }}};
}

}  // namespace touchstone::entries
