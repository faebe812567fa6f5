// An implicit packed R-tree, a tree of boxes without pointers: blocks of 16 consecutive boxes, the
// bounds of each block, the bounds of 16 blocks, and so on. Used by packed-rtree and verlet-list.
// Paper: Wald, Benthin, Boulos, "Getting Rid of Packets", RT 2008 (wide nodes for wide vectors).
//
// The order of the boxes decides its quality: along a space-filling curve the blocks are small.
// Empty boxes may fill up blocks; they overlap nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/body_marks.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/structure_box.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/boxes/aabb_stack.h"
#include "algorithms/kernels/boxes/group_search.h"

namespace touchstone {

class ImplicitRTree {
 public:
  static constexpr std::size_t fan = 16;           // boxes of a block, and children of a node
  static constexpr std::size_t group = fan * fan;  // boxes that search together

  ImplicitRTree() : levels_(1) { levels_.reserve(9); }  // enough for 2^32 boxes

  // Makes the tree over `count` boxes, at least one. fill(first, last) is called for ranges of them,
  // each of which begins at a multiple of `group`, and writes those boxes to boxes(). What a task has
  // filled in it bounds at once, while it has it in the cache.
  template <class Fill>
  void fit(Executor& executor, std::size_t count, const Fill& fill) {
    constexpr std::size_t places_a_task = 4 * group;
    resize(count);
    for_each_block(executor, count, places_a_task,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     fill(first, last);
                     bound_groups(first, last);
                   });
    bound_above(executor);
  }
  AabbSoA& boxes() { return levels_[0]; }
  const AabbSoA& boxes() const { return levels_[0]; }

  std::size_t groups() const { return (boxes().size() + group - 1) / group; }
  // levels()[0] holds the boxes, levels()[1] the bounds of blocks of them, levels()[2] those of
  // groups, and each further level those of 16 nodes of the one before; the last has one node.
  std::span<const AabbSoA> levels() const { return {levels_.data(), used_}; }
  // Returns the sum of the sides of all blocks' bounds (metres); a better order makes it smaller.
  double spread() const;
  // Returns the nodes from the root down, at their depths; the boxes themselves are no nodes.
  std::vector<StructureBox> structure() const;
  std::size_t held_bytes() const;

 private:
  void resize(std::size_t count);
  // Computes the bounds of the blocks and groups of these boxes.
  void bound_groups(std::size_t first, std::size_t last);
  // Computes the bounds of the levels above the groups.
  void bound_above(Executor& executor);

  std::vector<AabbSoA> levels_;
  std::size_t used_ = 1;
};

// Lists and counters of a search; one for each worker, which shares no cache line with that of another.
struct alignas(64) RTreeScratch {
  std::vector<std::uint32_t> nodes, children;  // nodes of two consecutive levels
  AabbStack blocks;                            // bounds and numbers of the blocks near the group
  std::vector<std::uint32_t> others;           // blocks that overlap one of the group's
  GroupLists lists;
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
};

// Writes the ids of each pair of boxes that overlap, one of them in this group, the other in the
// same block or a later one: each pair once over all groups. A pair of boxes of different sizes
// costs least if the smaller one precedes the larger.
void pair_group(const ImplicitRTree& tree, std::size_t group, RTreeScratch& scratch,
                PairBuffer& out);

// Writes the ids of the boxes that overlap `box` to scratch.children, and returns their number.
std::size_t list_overlaps(const ImplicitRTree& tree, const Aabb& box, RTreeScratch& scratch);

// Returns true if searches for so many bodies alone take less than one for all.
constexpr bool are_few(std::size_t bodies, std::size_t all) { return 8 * bodies <= all; }

// Writes each pair of boxes that overlap and of which one body, or both, is among `bodies`: what
// BroadPhase::find_pairs_of does. The tree is that of these boxes, `asked` marks the bodies, and
// `scratch` holds one entry for each worker. The order of the pairs does not depend on the width.
void search_bodies(Executor& executor, const ImplicitRTree& tree, std::span<const Aabb> boxes,
                   std::span<const std::uint32_t> bodies, const BodyMarks& asked,
                   std::vector<RTreeScratch>& scratch, PairSink& sink);

}  // namespace touchstone
