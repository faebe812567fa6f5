// Compares the pairs that a broad phase found with the true ones.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone::grade {

// Differences between a found set of pairs and the true one, counted by kind.
struct PairFaults {
  std::int64_t missing = 0;          // overlap, but not reported: always an error
  std::int64_t stale = 0;            // reported; overlapped in the frame before, but no longer
  std::int64_t extra = 0;            // reported, but no overlap: a margin, or an error
  std::int64_t duplicate = 0;        // reported more than once, or with a >= b
  std::optional<IndexPair> example;  // one of them, the most serious kind first

  bool none() const { return missing + stale + extra + duplicate == 0; }
};

// Sorts `found`. `truth` must be sorted and without repetition. `before` has the boxes of the frame
// before, and is empty in the first frame.
PairFaults check_pairs(std::vector<IndexPair>& found, std::span<const IndexPair> truth,
                       std::span<const Aabb> before);

// Returns words such as "3 missing, 1 duplicate (first: 17-203)".
std::string to_string(const PairFaults& faults);

}  // namespace touchstone::grade
