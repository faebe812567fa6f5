// Compares the pairs that a broad phase found with those that there are.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone::grade {

// How a found set of pairs departs from the true one, each kind counted apart.
struct PairFaults {
  std::int64_t missing = 0;          // overlaps, not reported: always an error
  std::int64_t stale = 0;            // reported, overlapped in the frame before, does not now
  std::int64_t extra = 0;            // reported, does not overlap: a margin, or an error
  std::int64_t duplicate = 0;        // reported more than once, or with a >= b
  std::optional<IndexPair> example;  // one of them, the most serious kind first

  bool none() const { return missing + stale + extra + duplicate == 0; }
};

// `found` is sorted on the way. `truth` is sorted and without repetition. `before` are the boxes of
// the frame before, empty in the first frame.
PairFaults check_pairs(std::vector<IndexPair>& found, std::span<const IndexPair> truth,
                       std::span<const Aabb> before);

// "3 missing, 1 duplicate (first: 17-203)"
std::string to_string(const PairFaults& faults);

}  // namespace touchstone::grade
