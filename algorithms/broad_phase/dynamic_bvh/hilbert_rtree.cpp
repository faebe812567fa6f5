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

void HilbertRTree::pair_leaf(std::size_t leaf, HilbertRTreeScratch& scratch,
                             PairBuffer& out) const {
  tree_.find_partners(leaf, scratch.tree, scratch.group.work);
  scan_group(tree_.boxes(), tree_.places_of(leaf), tree_.bounds_of_leaf(leaf),
             scratch.tree.partners, scratch.group, out);
}

void HilbertRTree::find_pairs(PairSink& sink) {
  for (HilbertRTreeScratch& scratch : scratch_) tree_.make_room(scratch.tree);
  search_groups(executor_, leaves(), leaves_a_task, scratch_, sink,
                std::bind_front(&HilbertRTree::pair_leaf, this));
}

BroadPhaseWork HilbertRTree::work() const {
  HilbertRTreeScratch scratch;
  tree_.make_room(scratch.tree);
  count_groups(leaves(), scratch, std::bind_front(&HilbertRTree::pair_leaf, this));
  return scratch.group.work;
}

std::size_t HilbertRTree::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(order_, tree_));
}

}  // namespace touchstone
