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
// Cost:    O(n log n) build, O(n) refit, 64 bytes a part.
#include <algorithm>
#include <numeric>
#include <vector>

#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/mid_phase.h"

namespace touchstone {
namespace {

struct BinaryNode {
  Aabb box;
  // The left child is the next node. A leaf has no right child, and its part here instead.
  std::uint32_t right = 0;
  std::uint32_t part = 0;

  bool is_leaf() const { return right == 0; }
};

Aabb joined(const Aabb& a, const Aabb& b) {
  Aabb box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = std::min(a.min[k], b.min[k]);
    box.max[k] = std::max(a.max[k], b.max[k]);
  }
  return box;
}

// Twice the centre; 0 where there is none.
float centre(const Aabb& box, int axis) {
  const float sum = box.min[axis] + box.max[axis];
  return std::isfinite(sum) ? sum : 0;
}

class BinaryTree {
 public:
  explicit BinaryTree(std::span<const Aabb> boxes) : reach_(reach_of(boxes)) {
    std::vector<std::uint32_t> parts(boxes.size());
    std::iota(parts.begin(), parts.end(), 0u);
    nodes_.reserve(2 * boxes.size());
    if (!parts.empty()) split(boxes, parts);
  }

  void refit(std::span<const Aabb> boxes) {
    reach_ = reach_of(boxes);
    for (std::uint32_t n = static_cast<std::uint32_t>(nodes_.size()); n-- > 0;) {
      BinaryNode& node = nodes_[n];
      node.box =
          node.is_leaf() ? boxes[node.part] : joined(nodes_[n + 1].box, nodes_[node.right].box);
    }
  }

  const std::vector<BinaryNode>& nodes() const { return nodes_; }
  double reach() const { return reach_; }

 private:
  void split(std::span<const Aabb> boxes, std::span<std::uint32_t> parts) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({boxes[parts[0]], 0, parts[0]});
    if (parts.size() == 1) return;
    Vec3d mean = Vec3d::Zero(), squares = Vec3d::Zero();
    for (const std::uint32_t part : parts) {
      nodes_[number].box = joined(nodes_[number].box, boxes[part]);
      const Vec3d at(centre(boxes[part], 0), centre(boxes[part], 1), centre(boxes[part], 2));
      mean += at;
      squares += at.cwiseAbs2();
    }
    mean /= static_cast<double>(parts.size());
    int axis = 0;
    (squares / static_cast<double>(parts.size()) - mean.cwiseAbs2()).maxCoeff(&axis);
    const auto before = [&](std::uint32_t part) { return centre(boxes[part], axis) < mean[axis]; };
    auto middle = std::partition(parts.begin(), parts.end(), before);
    auto left = static_cast<std::size_t>(middle - parts.begin());
    // A split that takes off less than an eighth of many parts would make the tree too deep.
    if (std::min(left, parts.size() - left) < parts.size() / 8 + 1) {
      left = parts.size() / 2;
      std::nth_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(left),
                       parts.end(), [&](std::uint32_t p, std::uint32_t q) {
                         return centre(boxes[p], axis) < centre(boxes[q], axis);
                       });
    }
    split(boxes, parts.first(left));
    nodes_[number].right = static_cast<std::uint32_t>(nodes_.size());
    split(boxes, parts.subspan(left));
  }

  std::vector<BinaryNode> nodes_;
  double reach_;
};

class BinaryBvhMidPhase final : public MidPhase {
 public:
  std::uint32_t add(std::span<const Aabb> parts) override {
    trees_.emplace_back(parts);
    return static_cast<std::uint32_t>(trees_.size() - 1);
  }

  void refit(std::uint32_t body, std::span<const Aabb> parts) override {
    trees_[body].refit(parts);
  }

  bool find_pairs(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                  const TakePartPairs& take) override {
    const BinaryTree &first = trees_[a], &second = trees_[b];
    if (first.nodes().empty() || second.nodes().empty()) return true;
    const CommonFrame frame = common_frame(pose_a, first.reach(), pose_b, second.reach());
    const double slack = box_slack(frame, first.reach(), second.reach());
    open_.assign(1, {0, 0});
    while (!open_.empty()) {
      const IndexPair now = open_.back();
      open_.pop_back();
      const BinaryNode &node_a = first.nodes()[now.a], &node_b = second.nodes()[now.b];
      if ((node_a.is_leaf() && node_a.box.is_empty()) ||
          (node_b.is_leaf() && node_b.box.is_empty())) {
        continue;
      }
      const PlacedBox box_a(node_a.box, frame.a), box_b(node_b.box, frame.b);
      if (are_apart(box_a, box_b, slack)) continue;
      if (node_a.is_leaf() && node_b.is_leaf()) {
        const IndexPair found = {node_a.part, node_b.part};
        if (!take({&found, 1})) return false;
      } else if (node_b.is_leaf() ||
                 (!node_a.is_leaf() && !(box_a.half.sum() < box_b.half.sum()))) {
        open_.push_back({node_a.right, now.b});
        open_.push_back({now.a + 1, now.b});
      } else {
        open_.push_back({now.a, node_b.right});
        open_.push_back({now.a, now.b + 1});
      }
    }
    return true;
  }

 private:
  std::vector<BinaryTree> trees_;
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
