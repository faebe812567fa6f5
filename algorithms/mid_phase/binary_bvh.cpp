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

#include "algorithms/kernels/bvh/volume_trees.h"

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

class BoxTree : public VolumeTree<Aabb> {
 public:
  explicit BoxTree(std::span<const Aabb> parts) : VolumeTree(parts) { refit(parts); }

  void refit(std::span<const Aabb> parts) {
    reach_ = reach_of(parts);
    for (std::uint32_t n = static_cast<std::uint32_t>(volumes_.size()); n-- > 0;) {
      const BinaryTree::Node& node = tree_.nodes[n];
      volumes_[n] = node.is_leaf() ? parts[tree_.order[node.first]]
                                   : joined(volumes_[n + 1], volumes_[node.right]);
    }
  }
};

struct BoxComparison : PlacedTrees<BoxTree> {
  bool apart(std::uint32_t i, std::uint32_t j) {
    if (a.volume(i).is_empty() || b.volume(j).is_empty()) return true;
    box_a = PlacedBox(a.volume(i), frame.a);
    box_b = PlacedBox(b.volume(j), frame.b);
    return are_apart(box_a, box_b, slack);
  }
  bool splits_first(std::uint32_t, std::uint32_t) const {
    return !(box_a.half.sum() < box_b.half.sum());
  }
  bool meet(std::uint32_t, std::uint32_t) const { return true; }

  PlacedBox box_a = {}, box_b = {};  // of the last nodes
};

using BinaryBvhMidPhase = VolumeTreeMidPhase<BoxTree, BoxComparison>;

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
