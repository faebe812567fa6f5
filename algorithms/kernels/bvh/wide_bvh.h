// A tree of boxes with eight children a node, made for vector lanes: the planes of a node's eight
// boxes lie side by side, and every leaf but the last holds eight boxes. Used by what traverses
// triangles: ray casts, point queries and mid-phases.
// Papers: Wald, "On fast construction of SAH-based bounding volume hierarchies", RT 2007 (bins);
//         Wald, Benthin, Boulos, "Getting rid of packets", RT 2008 (wide nodes).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"

namespace touchstone {

// 256 bytes. planes[0..2] are the lower ends of the children's boxes on x, y and z, planes[3..5]
// the upper ones, a lane a child. Lanes without a child come last and have an empty box.
struct alignas(64) WideNode {
  static constexpr std::size_t fan = 8;
  static constexpr std::int32_t no_child = std::numeric_limits<std::int32_t>::min();

  std::array<std::array<float, fan>, 6> planes;
  // The number of a node, greater than this one's; or -1 - the number of a leaf; or no_child.
  std::array<std::int32_t, fan> child;
  std::array<std::int32_t, fan> spare;

  static constexpr bool is_leaf(std::int32_t child) { return child < 0; }  // no_child too
  static constexpr std::uint32_t leaf(std::int32_t child) {
    return static_cast<std::uint32_t>(-1 - child);
  }
};
static_assert(sizeof(WideNode) == 256);

struct WideBvh {
  static constexpr std::size_t leaf_size = 8;
  // No node lies deeper, whatever the boxes (the root's depth is 0), so that a stack of `most_open`
  // children is enough for a walk through one tree.
  static constexpr std::size_t greatest_depth = 36;
  static constexpr std::size_t most_open = (greatest_depth + 1) * (WideNode::fan - 1) + 1;

  std::vector<WideNode> nodes;       // the root first, parents before children; none if no boxes
  std::vector<std::uint32_t> order;  // the boxes' numbers; leaf k has those from 8 k on

  std::size_t leaves() const { return (order.size() + leaf_size - 1) / leaf_size; }
  // The numbers of the boxes in a leaf: eight, and one to eight in the last.
  std::span<const std::uint32_t> leaf(std::size_t number) const {
    const std::span<const std::uint32_t> from = std::span(order).subspan(number * leaf_size);
    return from.first(from.size() < leaf_size ? from.size() : leaf_size);
  }
};

// The same boxes give the same tree. Any boxes are allowed: equal, infinite and empty ones too.
// There are at most 2^32 - 1.
WideBvh build_wide_bvh(std::span<const Aabb> boxes);

// Fits the nodes to boxes that moved; the tree keeps its form. There are as many boxes as at the
// build.
void refit(WideBvh& tree, std::span<const Aabb> boxes);

}  // namespace touchstone
