// The nodes of a kd-tree over bodies that lie one behind the other in their order, with the bounds
// of their bodies. Built and fitted on all threads.
// Paper:   Serpa, Rodrigues, "Flexible Use of Temporal and Spatial Reasoning for Fast and Scalable
//          CPU Broad-Phase Collision Detection Using KD-Trees", Computer Graphics Forum 2019.
// Departs: each node keeps the bounds of its bodies, see kd_bodies.h for the split. Nodes of at
//          most 2048 bodies are built with all that is below them by one task.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase/kd_tree/kd_bodies.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// Its own bodies come first, then those of the left and of the right child.
struct KdNode {
  static constexpr std::uint32_t none = 0xffffffff;

  Aabb bounds = Aabb::empty();  // of all of them
  std::uint32_t first = 0, own_end = 0, last = 0;
  std::uint32_t left = none;  // the right one is the next; none of a leaf
  bool is_leaf() const { return left == none; }
};

// A node above the cut, or at it: then the whole of what is below it is made by one task.
struct KdTop {
  std::uint32_t parent;  // in the list of these; none of the root
  KdPart part;
  KdSplit split = {};
  double spread = 0;  // of the leaves below it: the sum of their bounds' sides, metres

  bool is_whole() const { return split.is_leaf(); }
};

// Keeps its memory.
class KdNodes {
 public:
  // Of the boxes of these bodies.
  void build(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);
  // New boxes of the same bodies in the same nodes.
  void update(Executor& executor, std::span<const Aabb> boxes);

  const AabbSoA& boxes() const { return arrays_; }  // in the order of the tree
  const KdNode& operator[](std::size_t node) const { return nodes_[node]; }
  std::span<const KdTop> tops() const { return tops_; }  // parents come first
  std::uint32_t node_of_top(std::size_t top) const {
    return base_ + static_cast<std::uint32_t>(top);
  }
  // Of all leaves.
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
  // Those below a top node begin at half the place of its first body, since there are at least four
  // bodies a leaf; the top nodes come behind them all.
  std::vector<KdNode> nodes_;
  std::uint32_t base_ = 0;  // where the top nodes begin
  std::vector<KdTop> tops_;
};

}  // namespace touchstone
