// A tree of boxes without pointers: blocks of 16 boxes that lie one behind the other, the bounds of
// each block, the bounds of 16 blocks, and so on.
// Paper: Wald, Benthin, Boulos, "Getting Rid of Packets", RT 2008 (wide nodes for wide vectors).
//
// The order of the boxes decides how good it is: along a space-filling curve the blocks are small.
// There may be empty boxes among them, to fill up blocks; they overlap nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/boxes/aabb_stack.h"
#include "algorithms/kernels/boxes/group_search.h"

namespace touchstone {

class ImplicitRTree {
 public:
  static constexpr std::size_t fan = 16;           // boxes a block, nodes a node
  static constexpr std::size_t group = fan * fan;  // boxes that look for partners together

  ImplicitRTree() : levels_(1) { levels_.reserve(9); }  // 2^32 boxes have no more

  // To be filled in, then fitted.
  AabbSoA& boxes() { return levels_[0]; }
  const AabbSoA& boxes() const { return levels_[0]; }
  // Bounds of the boxes as they stand; there is one at least.
  void fit(Executor& executor);

  std::size_t groups() const { return (boxes().size() + group - 1) / group; }
  // levels()[0] is the boxes, levels()[1] bounds blocks of them, levels()[2] groups, each further
  // level 16 of the one before; the last has one node.
  std::span<const AabbSoA> levels() const { return {levels_.data(), used_}; }
  // Sum over the blocks of the sums of their bounds' sides (metres): what a better order would make
  // smaller.
  double spread() const;
  std::size_t held_bytes() const;

 private:
  std::vector<AabbSoA> levels_;
  std::size_t used_ = 1;
};

// What a search lists, and what it counts. One a worker.
struct RTreeScratch {
  std::vector<std::uint32_t> nodes, children;  // of two levels, one below the other
  AabbStack blocks;                            // near the group: their bounds and numbers
  NearList near;
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
};

// Writes the ids of each pair of boxes that overlap, one of them in this group, the other in the
// same block or in one behind it: each pair once over all groups. A pair of boxes of different
// sizes costs least when the smaller one comes first.
void pair_group(const ImplicitRTree& tree, std::size_t group, RTreeScratch& scratch,
                PairBuffer& out);

// The ids of the boxes that overlap this one, into scratch.children; how many.
std::size_t list_overlaps(const ImplicitRTree& tree, const Aabb& box, RTreeScratch& scratch);

}  // namespace touchstone
