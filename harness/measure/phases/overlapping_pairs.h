// The pairs of boxes that overlap, found by the harness itself: the reference for broad phases.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone::measure {

// The largest number of boxes for which the naive broad phase tests every pair; with more boxes,
// which would take minutes, a tree excludes those that are certainly apart.
inline constexpr std::size_t most_boxes_to_test_all = 30'000;

// Returns the pairs sorted, a < b, each once. Empty boxes have no pairs. It runs in the caller's
// thread.
std::vector<IndexPair> overlapping_pairs(std::span<const Aabb> boxes,
                                         std::size_t most_to_test_all = most_boxes_to_test_all);

}  // namespace touchstone::measure
