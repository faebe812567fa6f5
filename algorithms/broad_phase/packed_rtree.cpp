// Packed R-tree: boxes of about one size in the order of a Hilbert curve, in blocks of 16 under an
// implicit tree of bounds without pointers; groups of 256 boxes query it together.
// Paper:   Kamel, Faloutsos, "On Packing R-trees", CIKM 1993 (Hilbert order, full nodes); Wald,
//          Benthin, Boulos, "Getting Rid of Packets", RT 2008 (wide nodes for wide vectors).
// Steps:   1. Sort the boxes by size class and then along a Hilbert curve
//             (kernels/bvh/hilbert_sort.h).
//          2. Bound every 16 boxes by a block, every 16 blocks by a group, and so on to the root
//             (kernels/bvh/implicit_rtree.h).
//          3. In an update keep the order and repeat step 2; start at step 1 when the blocks' sides
//             have grown by a quarter, or bodies come or go.
//          4. For each group of 256 boxes, descend the tree level by level and list the blocks that
//             overlap the group's bounds and are not before it.
//          5. For each block of the group, narrow that list to the blocks that overlap it, and list
//             the boxes of these that overlap its bounds.
//          6. Test the boxes of each block against each other, and each listed box against the 16 at
//             once. List those that overlap any, and write their pairs.
// Departs: boxes much larger than the extent of a block follow in a class of their own, so that
//          they do not inflate the bounds of small ones. Blocks are paired only with those after
//          them, so each pair comes once. Each stage goes through all blocks of the group and
//          lists its candidates for the next one, which leaves few branches to mispredict. While bodies move a little
//          the order is kept.
// Fails:   long thin boxes in all directions: their blocks overlap in any order.
// Cost:    O(n) time for order and tree, O(n + k) expected for the search; k = pairs that overlap.
//          About 50 bytes a body.
#include <algorithm>
#include <cstdint>
#include <functional>

#include "algorithms/broad_phase.h"
#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/bvh/hilbert_sort.h"
#include "algorithms/kernels/bvh/implicit_rtree.h"

namespace touchstone {
namespace {

class PackedRTree final : public BroadPhase {
 public:
  explicit PackedRTree(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    order_.make(executor_, boxes);
    fit(boxes);
    spread_ = tree_.spread();
  }

  void update(const FrameChange& change) override {
    if (!change.inserted.empty() || !change.removed.empty()) return build(change.boxes);
    boxes_ = change.boxes;
    if (change.moved.empty()) return;
    fit(change.boxes);
    // The negation makes a NaN, from bounds that overflow, rebuild the order.
    if (!(tree_.spread() <= 1.25 * spread_)) build(change.boxes);
  }

  Status find_pairs(PairSink& sink) override {
    search_groups(executor_, groups(), groups_a_task, scratch_, sink,
                  std::bind_front(pair_group, std::cref(tree_)));
    return Status::ok;
  }

  Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) override {
    if (order_.empty() || !are_few(bodies.size(), boxes_.size())) {
      return BroadPhase::find_pairs_of(bodies, sink);
    }
    asked_.set(bodies);
    search_bodies(executor_, tree_, boxes_, bodies, asked_, scratch_, sink);
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    RTreeScratch scratch;
    count_groups(groups(), scratch, std::bind_front(pair_group, std::cref(tree_)));
    scratch.work.bytes = sum_held_bytes(order_, tree_);
    return scratch.work;
  }

  // The nodes with their depths.
  std::vector<StructureBox> structure() const override {
    return order_.empty() ? std::vector<StructureBox>{} : tree_.structure();
  }

 private:
  static constexpr std::size_t groups_a_task = 2;

  std::size_t groups() const { return order_.empty() ? 0 : tree_.groups(); }
  void fit(std::span<const Aabb> boxes) {
    boxes_ = boxes;
    if (order_.empty()) return;
    tree_.fit(executor_, order_.places(), [&](std::size_t first, std::size_t last) {
      order_.gather(boxes, first, last, tree_.boxes());
    });
  }

  Executor& executor_;
  std::vector<RTreeScratch> scratch_;
  std::span<const Aabb> boxes_;  // boxes of this frame
  HilbertSort order_;
  ImplicitRTree tree_;
  BodyMarks asked_;    // scratch
  double spread_ = 0;  // spread of the blocks when the order was made
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_packed_rtree() {
  return {
      {.info = {.name = "packed-rtree",
                .citation = "Kamel, Faloutsos, \"On Packing R-trees\", CIKM 1993; size classes, "
                            "implicit 16-ary tree"},
       .make = [](Executor& executor) { return std::make_unique<PackedRTree>(executor); }}};
}

}  // namespace touchstone::entries
