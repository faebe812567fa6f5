// A group of boxes against runs of others, at the level of vector instructions that isa() allows;
// comparisons only, so what is written is the same at every level. How: group_search.h.
#pragma once

#include <span>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/boxes/group_search.h"

namespace touchstone {

// What a scan lists, and what it counts. One a worker.
struct GroupScratch {
  NearList near;
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
};

// Of at least one box.
Aabb bounds_of(const AabbSoA& boxes, IndexRange range);

// Writes the ids of each pair of boxes of the group that overlap, and of a box of the group with
// one of `others`. `bounds`: of the group, of at most `group_size` boxes. The others do not hold a
// box of the group.
void scan_group(const AabbSoA& boxes, IndexRange group, const Aabb& bounds,
                std::span<const IndexRange> others, GroupScratch& scratch, PairBuffer& out);

}  // namespace touchstone
