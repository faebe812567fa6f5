// All pairs of parts of two bodies that share a point, by number and fingerprint.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/core/pair_sink.h"
#include "harness/base/hash.h"

namespace touchstone::grade {

struct PartList {
  std::uint64_t count = 0, hash = 0;
  bool operator==(const PartList&) const = default;
};

inline PartList part_list(std::span<const IndexPair> pairs) {
  return {pairs.size(), base::pair_hash(pairs)};
}

}  // namespace touchstone::grade
