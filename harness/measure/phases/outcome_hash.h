// The hash of the answers to a set of pairs.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "algorithms/core/outcome.h"
#include "harness/base/hash.h"
#include "harness/grade/concave/part_list.h"
#include "harness/grade/pair_groups.h"

namespace touchstone::measure {

// It does not depend on the order of the pairs or on the number of threads. It is a sum modulo 2^64
// over the pairs, so the hash of several frames is the sum of their hashes.
inline std::uint64_t outcome_hash(const grade::PairGroup& group,
                                  std::span<const Outcome> outcomes) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    std::uint64_t hash = base::mix((std::uint64_t{group.first[i]} << 32) + group.second[i]);
    hash = base::mix(hash ^ (static_cast<std::uint64_t>(outcome.answer) << 8) ^
                     static_cast<std::uint64_t>(outcome.status));
    // Every NaN has the same hash: it means that there is no number.
    if (!std::isnan(outcome.distance)) {
      hash = base::mix(hash ^ std::bit_cast<std::uint64_t>(outcome.distance));
    }
    sum += hash;
  }
  return sum;
}

// The hash of the lists of pairs of parts, which is added to that of the outcomes; 0 without lists.
// `lists` may go on behind those of the group.
inline std::uint64_t list_hash(const grade::PairGroup& group,
                               std::span<const grade::PartList> lists) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; !lists.empty() && i < group.size(); ++i) {
    const std::uint64_t pair =
        base::mix((std::uint64_t{group.first[i]} << 32) + group.second[i] + 1);
    sum += base::mix(base::mix(pair ^ lists[i].count) ^ lists[i].hash);
  }
  return sum;
}

// The hash of the pairs of a group, made of their pair_hash.
inline std::uint64_t group_hash(const grade::PairGroup& group) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::uint32_t a = group.first[i];
    const std::uint32_t b = group.second[i];
    sum += base::mix((std::uint64_t{a < b ? a : b} << 32) + (a < b ? b : a));
  }
  return sum;
}

}  // namespace touchstone::measure
