// All pairs of boxes below a tree's root: each node is handed a list of those behind it, and picks
// from it, and from the parts of these, what it overlaps itself. At the level of vector
// instructions that isa() allows; comparisons only, so what is written is the same at every level.
// Paper: Brinkhoff, Kriegel, Seeger, "Efficient Processing of Spatial Joins Using R-trees", SIGMOD
//        1993 (both sides go down together, and only what lies in both bounds goes on).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/broad_phase_work.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/boxes/aabb_stack.h"

namespace touchstone {

// Where what is below a node begins, and how much it is: up to 16 boxes below a leaf, one behind
// the other; else a block of up to 16 nodes.
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

// Blocks of 16 places for nodes; the root's nodes are block 0. Keeps its memory.
struct JoinTree {
  AabbSoA nodes;                      // bounds; ids: NodeRefs; empty boxes fill a block up
  std::vector<std::uint32_t> parent;  // of each block: the place of the node whose parts it has

  std::size_t held_bytes() const {
    return nodes.held_bytes() + parent.capacity() * sizeof(std::uint32_t);
  }
};

// What a join lists, and what it counts. One a worker.
struct JoinScratch {
  static constexpr std::size_t near_at_once = 512;

  AabbStack list;
  std::vector<std::uint32_t> leaves, inner;
  std::array<std::uint32_t, near_at_once + NodeRef::fan> near;
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
};

// Which nodes of a block look for partners: all, with what is below them, or the leaves alone.
enum class JoinPart : std::uint8_t { all, leaves };

// Writes the ids of each pair of boxes that overlap, one of them below one of these nodes, the
// other in the same leaf or behind it. What is above the block is gone through once more for each
// call.
void join_block(const JoinTree& tree, const AabbSoA& boxes, std::size_t block, JoinPart part,
                JoinScratch& scratch, PairBuffer& out);

}  // namespace touchstone
