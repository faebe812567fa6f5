// kd-tree whose nodes hold their bodies one behind the other: what of one half reaches into the
// other is handed down as a list, and the leaves are tested a vector at a time.
// Paper:   Serpa, Rodrigues, "Flexible Use of Temporal and Spatial Reasoning for Fast and Scalable
//          CPU Broad-Phase Collision Detection Using KD-Trees", Computer Graphics Forum 2019.
// Departs: bodies are split by their centres, and each node keeps the bounds of its bodies, so that
//          only those stay at an inner node that are large for it: with all that straddle the
//          plane, most of a uniform scene would. See kernels/kd_bodies.h for where the plane is.
//          While bodies move a little the tree is kept, and made anew when the bounds of its leaves
//          have grown by a quarter.
// Fails:   long thin boxes in all directions: the bounds of all nodes overlap, and each leaf is
//          tested against all that comes before it.
// Cost:    O(n log n) time, O(n log n + k) to be expected for the search; k = pairs that overlap.
//          About 100 bytes a body.
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
    // Written so that a NaN, of bounds that overflow, makes a new tree.
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

 private:
  static constexpr std::uint32_t rows_a_task = 512;
  // A node of no more is not looked into for those of its bodies that overlap a bound.
  static constexpr std::uint32_t collected_at_once = 256;

  // To look for the partners of some bodies of a top node's own; of all below it, too, if it is
  // whole.
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

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  KdNodes nodes_;
  std::vector<Task> tasks_;
  double spread_ = 0;
};

// Many bodies of a node's own, that are large or lie in one place, are cut into several tasks.
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

// What comes before a top node in the tree is gone through once more for each of them.
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

// The list: all bodies that come before the node's own and could overlap one of them.
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

// Of the node's bodies and of all below it.
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

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {
      {.info = {.name = "kd-tree",
                .citation = "Serpa, Rodrigues, \"Flexible Use of Temporal and Spatial Reasoning "
                            "... Using KD-Trees\", Computer Graphics Forum 2019; split by "
                            "centres, with bounds"},
       .make = [](touchstone::Executor& executor) {
         return std::make_unique<touchstone::KdTree>(executor);
       }}};
}
