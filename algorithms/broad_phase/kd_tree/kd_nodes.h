// Part of kd-tree: the nodes over the ordered bodies, with their bounds. They are built and
// refitted on all threads.
// Paper:   Serpa, Rodrigues, "Flexible Use of Temporal and Spatial Reasoning for Fast and Scalable
//          CPU Broad-Phase Collision Detection Using KD-Trees", Computer Graphics Forum 2019.
// Departs: each node keeps the bounds of its bodies; kd_bodies.h describes the split. One task
//          builds the whole subtree of a node of at most 2048 bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase/kd_tree/kd_bodies.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// A node: its own bodies come first, then those of the left and of the right child.
struct KdNode {
  static constexpr std::uint32_t none = 0xffffffff;

  Aabb bounds = Aabb::empty();  // bounds of all its bodies
  std::uint32_t first = 0, own_end = 0, last = 0;
  std::uint32_t left = none;  // the right child is the next node; none for a leaf
  bool is_leaf() const { return left == none; }
};

// A top node: above the cut, or at it; one task builds the whole subtree of a node at the cut.
struct KdTop {
  std::uint32_t parent;  // index among the top nodes; none for the root
  KdPart part;
  KdSplit split = {};
  double spread = 0;  // sum of the sides of the bounds of the leaves below it, metres

  bool is_whole() const { return split.is_leaf(); }
};

// The nodes of the tree; they keep their memory.
class KdNodes {
 public:
  // Builds the tree of the boxes of these bodies.
  void build(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);
  // Replaces the boxes of the same bodies, in the same nodes.
  void update(Executor& executor, std::span<const Aabb> boxes);

  const AabbSoA& boxes() const { return arrays_; }  // sorted as in the tree
  const KdNode& operator[](std::size_t node) const { return nodes_[node]; }
  std::span<const KdTop> tops() const { return tops_; }  // parents come first
  std::uint32_t node_of_top(std::size_t top) const {
    return base_ + static_cast<std::uint32_t>(top);
  }
  // The sum of the sides of all leaves' bounds, metres.
  double spread() const;

  std::size_t held_bytes() const;

 private:
  static constexpr std::uint32_t cut_size = 2048;

  void grow(const KdPart& part, KdNode& node, std::uint32_t& next);
  void fit(Executor& executor);
  void fit(KdNode& node, double& spread);
  void fit_inner(KdNode& node);
  Aabb fit_own(const KdNode& node);

  KdBodies bodies_;
  AabbSoA arrays_;
  // Nodes below a top node begin at half of the place of its first body, since a leaf has at least
  // four bodies; the top nodes come after all of these.
  std::vector<KdNode> nodes_;
  std::uint32_t base_ = 0;  // first of the top nodes
  std::vector<KdTop> tops_;
};

}  // namespace touchstone
