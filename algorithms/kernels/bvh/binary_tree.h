// The form of a binary tree over parts, and the descent of two such trees together, whatever volumes the
// nodes have. Used by `binary-bvh`, `obb-tree` and `sphere-tree`.
// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (the split at the mean of centres; the descent).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

struct BinaryTree {
  // The left child is the next node. A leaf has no right child, and one part.
  struct Node {
    std::uint32_t right = 0;
    std::uint32_t first, count;  // its parts: of `order`

    bool is_leaf() const { return right == 0; }
  };
  std::vector<Node> nodes;           // the root first, parents before children; none without parts
  std::vector<std::uint32_t> order;  // the parts' numbers

  std::span<const std::uint32_t> parts(std::size_t node) const {
    return std::span(order).subspan(nodes[node].first, nodes[node].count);
  }
};

// Splits the parts at the mean of their boxes' centres, on the axis on which these are spread the most;
// half of them each where that takes off less than an eighth. Boxes may be empty or boundless.
BinaryTree build_binary_tree(std::span<const Aabb> boxes);

// Descends both trees from their roots: drops pairs of nodes that are `apart(a, b)`, and splits that of
// a if `splits_first(a, b)`, or where the other is a leaf. Calls `take(part_a, part_b)` for the leaves
// that remain, until it returns false; returns false then. `open` is room for the descent.
template <class Apart, class SplitsFirst, class Take>
bool descend(const BinaryTree& a, const BinaryTree& b, std::vector<IndexPair>& open,
             const Apart& apart, const SplitsFirst& splits_first, const Take& take) {
  open.clear();
  if (!a.nodes.empty() && !b.nodes.empty()) open.push_back({0, 0});
  while (!open.empty()) {
    const IndexPair now = open.back();
    open.pop_back();
    if (apart(now.a, now.b)) continue;
    const BinaryTree::Node &node_a = a.nodes[now.a], &node_b = b.nodes[now.b];
    if (node_a.is_leaf() && node_b.is_leaf()) {
      if (!take(a.order[node_a.first], b.order[node_b.first])) return false;
    } else if (node_b.is_leaf() || (!node_a.is_leaf() && splits_first(now.a, now.b))) {
      open.push_back({node_a.right, now.b});
      open.push_back({now.a + 1, now.b});
    } else {
      open.push_back({now.a, node_b.right});
      open.push_back({now.a, now.b + 1});
    }
  }
  return true;
}

}  // namespace touchstone
