// Scans and sweeps: tests of boxes against runs of boxes, many at a time, at the level of vector
// instructions that isa() allows. They only compare, so every level gives the same pairs. Used by
// naive, the sweeps, uniform-grid, verlet-list and moving_pairs.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/boxes/aabb_soa.h"

namespace touchstone {

// Tests each box of `rows` against each range of `columns`, and writes the ids of pairs that
// overlap. A range that contains the row starts after it for that row, so scan_boxes(b, r, {r})
// tests each pair of r once.
void scan_boxes(const AabbSoA& boxes, IndexRange rows, std::span<const IndexRange> columns,
                PairBuffer& out);

// Scans boxes with marks: a pair counts only if marks[column] has every bit of wants[row]. Both
// arrays are indexed and padded like the boxes.
void scan_marked_boxes(const AabbSoA& boxes, std::span<const std::uint32_t> marks,
                       std::span<const std::uint32_t> wants, IndexRange rows, IndexRange columns,
                       PairBuffer& out);

// Returns the number of pairs that a scan tests, for one range of columns.
std::size_t pairs_of_scan(IndexRange rows, IndexRange columns);

// Tests each box of `rows` against those after it that start before it ends, and writes the ids of
// pairs that overlap. The boxes are in ascending order of their minimum on `axis`.
void sweep_boxes(const AabbSoA& boxes, int axis, IndexRange rows, PairBuffer& out);

// Sweeps boxes with marks; the boxes before `end` are in that order, and the rows are among them.
void sweep_marked_boxes(const AabbSoA& boxes, std::span<const std::uint32_t> marks,
                        std::span<const std::uint32_t> wants, int axis, IndexRange rows,
                        std::size_t end, PairBuffer& out);

// Returns the box tests and candidates of a sweep. The candidates of a row are the boxes after it
// that start before it ends; one more test finds their end, unless that is `end`.
BroadPhaseWork work_of_sweep(const AabbSoA& boxes, int axis, IndexRange rows, std::size_t end);

}  // namespace touchstone
