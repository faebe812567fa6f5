// The pairs of boxes that overlap, by the harness's own means: what broad phases are held against.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone::measure {

// Up to so many boxes every pair is tested, by the naive broad phase; beyond, where that would take
// minutes, a tree of boxes leaves out those that are certainly apart.
inline constexpr std::size_t most_boxes_to_test_all = 30'000;

// Sorted, a < b, each once. Empty boxes have no pairs. Runs in the caller's thread.
std::vector<IndexPair> overlapping_pairs(std::span<const Aabb> boxes,
                                         std::size_t most_to_test_all = most_boxes_to_test_all);

}  // namespace touchstone::measure
