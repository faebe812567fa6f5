// The scan of a group of boxes against runs of others, at the level of vector instructions that
// isa() allows. It only compares, so every level writes the same pairs. group_search.h describes
// how. Used by linear-bvh, hierarchical-grid, loose-octree and dynamic-bvh.
#pragma once

#include <span>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/boxes/group_search.h"

namespace touchstone {

// Lists and counters of a scan; one for each worker.
struct GroupScratch {
  GroupLists lists;
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
};

// Returns the bounds of at least one box.
Aabb bounds_of(const AabbSoA& boxes, IndexRange range);

// Writes the ids of each pair of the group's boxes that overlap, and of each pair of one of them
// and one of `others`. `bounds` are the group's; it has at most `group_size` boxes, and `others`
// contain none of them.
void scan_group(const AabbSoA& boxes, IndexRange group, const Aabb& bounds,
                std::span<const IndexRange> others, GroupScratch& scratch, PairBuffer& out);

}  // namespace touchstone
