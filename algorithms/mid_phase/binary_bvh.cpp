// Binary BVH: trees of two boxes a node, descended together.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (the descent); van den Bergen, "Efficient
//          collision detection of complex deformable models using AABB trees", JGT 2(4), 1997 (with
//          boxes along the axes).
// Steps:   1. Split the parts at the mean of their boxes' centres, on the axis on which these are
//             spread the most; half of them each where that leaves a side empty. One part a leaf.
//          2. Descend both trees from their roots: drop two nodes whose boxes are apart, split the
//             larger of the two otherwise.
// Departs: boxes are compared along the three axes of the common frame alone.
// Fails:   each box of the second body is put into the frame each time that it is met.
// Cost:    O(n log n) build, O(n) refit, 76 bytes a part.
#include <algorithm>
#include <vector>

#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/kernels/bvh/binary_tree.h"
#include "algorithms/mid_phase_of_bodies.h"

namespace touchstone {
namespace {

Aabb joined(const Aabb& a, const Aabb& b) {
  Aabb box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = std::min(a.min[k], b.min[k]);
    box.max[k] = std::max(a.max[k], b.max[k]);
  }
  return box;
}

class BoxTree {
 public:
  explicit BoxTree(std::span<const Aabb> parts) : tree_(build_binary_tree(parts)) { refit(parts); }

  void refit(std::span<const Aabb> parts) {
    reach_ = reach_of(parts);
    boxes_.resize(tree_.nodes.size());
    for (std::uint32_t n = static_cast<std::uint32_t>(boxes_.size()); n-- > 0;) {
      const BinaryTree::Node& node = tree_.nodes[n];
      boxes_[n] = node.is_leaf() ? parts[tree_.order[node.first]]
                                 : joined(boxes_[n + 1], boxes_[node.right]);
    }
  }

  const BinaryTree& tree() const { return tree_; }
  const Aabb& box(std::uint32_t node) const { return boxes_[node]; }
  double reach() const { return reach_; }

 private:
  BinaryTree tree_;
  std::vector<Aabb> boxes_;  // of the nodes
  double reach_;
};

class BinaryBvhMidPhase final : public MidPhaseOfBodies<BoxTree> {
 public:
  bool find_pairs(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                  const TakePartPairs& take) override {
    const BoxTree &first = kept(a), &second = kept(b);
    const CommonFrame frame = common_frame(pose_a, first.reach(), pose_b, second.reach());
    const double slack = box_slack(frame, first.reach(), second.reach());
    PlacedBox box_a, box_b;
    return descend(
        first.tree(), second.tree(), open_,
        [&](std::uint32_t i, std::uint32_t j) {
          if (first.box(i).is_empty() || second.box(j).is_empty()) return true;
          box_a = PlacedBox(first.box(i), frame.a);
          box_b = PlacedBox(second.box(j), frame.b);
          return are_apart(box_a, box_b, slack);
        },
        [&](std::uint32_t, std::uint32_t) { return !(box_a.half.sum() < box_b.half.sum()); },
        [&](std::uint32_t i, std::uint32_t j) {
          const IndexPair found = {i, j};
          return take({&found, 1});
        });
  }

 private:
  std::vector<IndexPair> open_;  // pairs of nodes
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<MidPhaseEntry> mid_phase_binary_bvh() {
  return {{.info = {.name = "binary-bvh",
                    .citation = "G. van den Bergen, \"Efficient collision detection of complex "
                                "deformable models using AABB trees\", JGT 2(4), 1997"},
           .make = [] { return std::make_unique<BinaryBvhMidPhase>(); }}};
}

}  // namespace touchstone::entries
