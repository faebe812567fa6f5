// Part of loose-octree: the self-join of a tree, which finds all pairs of boxes below its root.
// Each node receives a list of later nodes, and picks from it, and from the parts of these, what
// overlaps it. It runs at the level of vector instructions that isa() allows; it only compares, so
// every level writes the same pairs.
// Paper: Brinkhoff, Kriegel, Seeger, "Efficient Processing of Spatial Joins Using R-trees", SIGMOD
//        1993 (both sides descend together, restricted to the intersection of their bounds).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/boxes/aabb_stack.h"
#include "algorithms/kernels/boxes/group_search.h"

namespace touchstone {

// A reference to what is below a node: up to 16 consecutive boxes of a leaf, or a block of up to 16
// nodes.
struct NodeRef {
  static constexpr std::uint32_t fan = 16;
  static constexpr std::uint32_t leaf_bit = 1;
  static constexpr std::size_t most_begins = std::size_t{1} << 27;

  std::uint32_t packed;

  // 1 <= count <= 16, begin < 2^27.
  static NodeRef leaf(std::uint32_t begin, std::uint32_t count) {
    return {begin << 5 | (count - 1) << 1 | leaf_bit};
  }
  static NodeRef inner(std::uint32_t block, std::uint32_t count) {
    return {block << 5 | (count - 1) << 1};
  }
  bool is_leaf() const { return (packed & leaf_bit) != 0; }
  std::size_t begin() const { return packed >> 5; }
  std::size_t count() const { return (packed >> 1 & 15) + 1; }
};

// Nodes in blocks of 16 places; block 0 holds the root's children. The tree keeps its memory.
struct JoinTree {
  AabbSoA nodes;                      // bounds; the ids are NodeRefs; empty boxes fill up a block
  std::vector<std::uint32_t> parent;  // place of the node whose parts each block holds

  std::size_t held_bytes() const {
    return nodes.held_bytes() + parent.capacity() * sizeof(std::uint32_t);
  }
};

// Lists and counters of a join; one for each worker.
struct JoinScratch {
  AabbStack list;
  std::vector<std::uint32_t> leaves, inner;
  GroupLists lists;
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
};

// The nodes of a block that look for partners: all, with their subtrees, or the leaves alone.
enum class JoinPart : std::uint8_t { all, leaves };

// Writes the ids of each pair of boxes that overlap, one of them below a node of this block, the
// other in the same leaf or a later one. Each call repeats the search from the root to the block.
void join_block(const JoinTree& tree, const AabbSoA& boxes, std::size_t block, JoinPart part,
                JoinScratch& scratch, PairBuffer& out);

}  // namespace touchstone
