// Tests of boxes against runs of boxes, many at a time, at the level of vector instructions that
// isa() allows. Comparisons only, so the answers are the same bits at every level.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// Tests each box of `rows` against each of each range of `columns`, and writes the ids of those
// that overlap. A range that holds the row itself is entered just behind it, so scan(b, r, {r})
// tests each pair of r once.
void scan_boxes(const AabbSoA& boxes, IndexRange rows, std::span<const IndexRange> columns,
                PairBuffer& out);

// The same with a mark on each box: a pair counts only where marks[column] has every bit that
// wants[row] has. Both are indexed like the boxes and padded like them.
void scan_marked_boxes(const AabbSoA& boxes, std::span<const std::uint32_t> marks,
                       std::span<const std::uint32_t> wants, IndexRange rows, IndexRange columns,
                       PairBuffer& out);

// How many pairs each of them tests, for one range of columns.
std::size_t pairs_of_scan(IndexRange rows, IndexRange columns);

// The boxes are in ascending order of their minimum on `axis`. Tests each box of `rows` against
// those behind it that start before it ends, and writes the ids of those that overlap.
void sweep_boxes(const AabbSoA& boxes, int axis, IndexRange rows, PairBuffer& out);

// The same with marks, for boxes that are in that order before `end`, and rows among these.
void sweep_marked_boxes(const AabbSoA& boxes, std::span<const std::uint32_t> marks,
                        std::span<const std::uint32_t> wants, int axis, IndexRange rows,
                        std::size_t end, PairBuffer& out);

// The box tests and candidates of both: a row's candidates are those behind it that start before it
// ends, and one test more finds where they end, unless `end` does.
BroadPhaseWork work_of_sweep(const AabbSoA& boxes, int axis, IndexRange rows, std::size_t end);

}  // namespace touchstone
