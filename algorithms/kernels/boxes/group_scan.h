// Up to 16 boxes that lie one behind the other and near each other, tested together against others:
// those that do not meet the group's bounds are left out 16 at a time, and each that is left is
// tested against the whole group at once. At the level of vector instructions that isa() allows;
// comparisons only, so what is written is the same at every level.
// Paper:   Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume
//          Hierarchies", ACM Transactions on Graphics 26, 2007 (a packet's bounds are tested
//          first).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

inline constexpr std::size_t group_size = 16;

// What a scan lists, and what it counts. One a worker.
struct GroupScratch {
  static constexpr std::size_t near_at_once = 512;

  std::array<std::uint32_t, near_at_once + group_size> near;
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
