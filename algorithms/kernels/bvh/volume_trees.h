// Mid-phases that keep a binary tree of volumes for each body, and descend two trees together. Used by binary-bvh,
// obb-tree and sphere-tree, which differ in the volume.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/kernels/bvh/binary_tree.h"
#include "algorithms/mid_phase_of_bodies.h"

namespace touchstone {

// The tree of a body's parts, with a volume for each node.
template <class Volume>
class VolumeTree {
 public:
  const BinaryTree& tree() const { return tree_; }
  const Volume& volume(std::uint32_t node) const { return volumes_[node]; }
  double reach() const { return reach_; }  // the greatest coordinate of the parts' boxes (metres)

 protected:
  explicit VolumeTree(std::span<const Aabb> parts)
      : tree_(build_binary_tree(parts)), volumes_(tree_.nodes.size()) {}

  BinaryTree tree_;
  std::vector<Volume> volumes_;
  double reach_ = 0;
};

// Two trees, in their common frame.
template <class Tree>
struct PlacedTrees {
  const Tree &a, &b;
  const CommonFrame& frame;
  double slack;  // of boxes along its axes (metres)
};

// Tree is a VolumeTree that is made from a body's boxes and has refit(boxes). Comparison is a PlacedTrees.
// Its apart(i, j) drops two nodes; splits_first(i, j) is called next for nodes that it keeps, and chooses
// that of the first tree; meet(i, j) takes two parts whose leaves it keeps.
template <class Tree, class Comparison>
class VolumeTreeMidPhase final : public MidPhaseOfBodies<Tree> {
 public:
  bool find_pairs(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                  const TakePartPairs& take) override {
    const Tree &first = this->kept(a), &second = this->kept(b);
    const CommonFrame frame = common_frame(pose_a, first.reach(), pose_b, second.reach());
    const double slack = box_slack(frame, first.reach(), second.reach());
    Comparison nodes{{first, second, frame, slack}};
    return descend(
        first.tree(), second.tree(), open_,
        [&](std::uint32_t i, std::uint32_t j) { return nodes.apart(i, j); },
        [&](std::uint32_t i, std::uint32_t j) { return nodes.splits_first(i, j); },
        [&](std::uint32_t i, std::uint32_t j) {
          if (!nodes.meet(i, j)) return true;
          const IndexPair found = {i, j};
          return take({&found, 1});
        });
  }

 private:
  std::vector<IndexPair> open_;  // pairs of nodes
};

}  // namespace touchstone
