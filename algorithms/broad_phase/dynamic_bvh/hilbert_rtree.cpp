// Part of dynamic-bvh: the reuse of the order, and the join of the loaded tree with itself.
#include "algorithms/broad_phase/dynamic_bvh/hilbert_rtree.h"

#include <algorithm>
#include <functional>

#include "algorithms/core/memory_usage.h"

namespace touchstone {

void HilbertRTree::forget_order() {
  is_sorted_ = false;
  order_ = {};
}

void HilbertRTree::sort_if_needed(std::span<const Aabb> boxes) {
  is_new_ = !is_sorted_;
  if (is_sorted_) return;
  order_.make(executor_, boxes);
  is_sorted_ = true;
}

// Returns false if the leaves have grown so much that a new order would be better.
bool HilbertRTree::is_good() {
  const double spread = tree_.spread();
  if (is_new_) spread_at_sort_ = spread;
  // A NaN, from bounds that overflow, compares false and so causes a new order.
  return is_new_ || spread <= 1.25 * spread_at_sort_;
}

void HilbertRTree::search(std::size_t task, HilbertRTreeScratch& scratch, PairBuffer& out) const {
  const std::size_t last = std::min((task + 1) * leaves_a_task, tree_.leaves());
  for (std::size_t leaf = task * leaves_a_task; leaf < last; ++leaf) {
    tree_.find_partners(leaf, scratch.tree, scratch.group.work);
    scan_group(tree_.boxes(), tree_.places_of(leaf), tree_.bounds_of_leaf(leaf),
               scratch.tree.partners, scratch.group, out);
  }
}

void HilbertRTree::find_pairs(PairSink& sink) {
  for (HilbertRTreeScratch& scratch : scratch_) tree_.make_room(scratch.tree);
  sink.start(tasks());
  const auto body = [&](std::size_t task, int worker) {
    search(task, scratch_[static_cast<std::size_t>(worker)], sink.chunk(task));
  };
  executor_.run(tasks(), std::cref(body));
}

BroadPhaseWork HilbertRTree::work() const {
  HilbertRTreeScratch scratch;
  tree_.make_room(scratch.tree);
  PairBuffer pairs;
  for (std::size_t task = 0; task < tasks(); ++task) {
    pairs.clear();
    search(task, scratch, pairs);
  }
  return scratch.group.work;
}

std::size_t HilbertRTree::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(order_, tree_));
}

}  // namespace touchstone
