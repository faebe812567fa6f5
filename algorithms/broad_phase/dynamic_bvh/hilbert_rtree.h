// Part of dynamic-bvh: a Hilbert-packed R-tree, which is a Bvh16 loaded in bulk along a Hilbert
// curve, and the search of all of its pairs.
// Papers:  Kamel, Faloutsos, "On Packing R-trees", CIKM 1993; Brinkhoff, Kriegel, Seeger,
//          "Efficient Processing of Spatial Joins Using R-trees", SIGMOD 1993 (the join of a tree
//          with itself).
// Departs: the order of the last load is used again while the leaves have not grown by a quarter;
//          leaves, not bodies, descend the tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase/dynamic_bvh/bvh16.h"
#include "algorithms/broad_phase_work.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/group_scan.h"
#include "algorithms/kernels/bvh/hilbert_sort.h"

namespace touchstone {

struct HilbertRTreeScratch {
  Bvh16Scratch tree;
  GroupScratch group;
};

// The tree keeps its memory, except for the order after forget_order().
class HilbertRTree {
 public:
  explicit HilbertRTree(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  // Requires a new order: the bodies differ from those of the last load.
  void change_bodies() { is_sorted_ = false; }
  // Releases the memory of the order if the next load is far off.
  void forget_order();

  // Loads all boxes that are not empty, each as box_of(id). Bvh16::start explains `is_to_change`.
  template <class BoxOf>
  void load(std::span<const Aabb> boxes, bool is_to_change, const BoxOf& box_of) {
    sort_if_needed(boxes);
    fill(boxes.size(), is_to_change, box_of);
    if (is_good()) return;
    change_bodies();
    sort_if_needed(boxes);
    fill(boxes.size(), is_to_change, box_of);
    is_good();
  }
  Bvh16& tree() { return tree_; }
  const Bvh16& tree() const { return tree_; }
  // Returns a worker's scratch; call it after the last change of the tree and before a search.
  Bvh16Scratch& scratch(int worker) {
    Bvh16Scratch& scratch = scratch_[static_cast<std::size_t>(worker)].tree;
    tree_.make_room(scratch);
    return scratch;
  }

  // Writes all pairs of boxes that overlap, of a tree that has not changed since it was loaded.
  void find_pairs(PairSink& sink);
  // The work of that search.
  BroadPhaseWork work() const;

  std::size_t held_bytes() const;

 private:
  static constexpr std::size_t leaves_a_task = 32;

  template <class BoxOf>
  void fill(std::size_t id_count, bool is_to_change, const BoxOf& box_of) {
    tree_.start(order_.size(), id_count, is_to_change);
    for_each_block(executor_, order_.size(), 4096,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       const std::uint32_t id = order_.id(i);
                       tree_.set(i, box_of(id), id);
                     }
                   });
    tree_.load(executor_);
  }
  std::size_t leaves() const { return tree_.loaded() == 0 ? 0 : tree_.leaves(); }
  void sort_if_needed(std::span<const Aabb> boxes);
  bool is_good();
  void pair_leaf(std::size_t leaf, HilbertRTreeScratch& scratch, PairBuffer& out) const;

  Executor& executor_;
  std::vector<HilbertRTreeScratch> scratch_;
  HilbertSort order_;
  bool is_sorted_ = false, is_new_ = false;  // the order is valid; the last load made it
  double spread_at_sort_ = 0;                // spread of the tree's leaves
  Bvh16 tree_;
};

}  // namespace touchstone
