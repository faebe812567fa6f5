// The fastest contestant of a set.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "harness/stats/samples.h"

namespace touchstone::stats {

// Returns the fastest of those that take part, by the ratio of each to the baseline in its own
// squares, without those that failed; null if there is none.
const Contestant* fastest(const SampleSet& set, Noise noise,
                          const std::function<bool(const Contestant&)>& takes_part);

// Returns the fastest of those that take part and are right; null if there is none.
const Contestant* fastest_right(const SampleSet& set, Noise noise,
                                const std::function<bool(const Contestant&)>& takes_part);

// The batches of the set's contestants, ascending. Those of different batches are asked differently, and
// do not compete.
std::set<std::int64_t> batches_of(const SampleSet& set);

// Returns the row of this set and label; null if there is none.
template <class Row>
const Row* find_row(const std::vector<Row>& rows, const SetKey& key, const std::string& label) {
  const auto at = std::ranges::find_if(
      rows, [&](const Row& row) { return row.key == key && row.label == label; });
  return at == rows.end() ? nullptr : &*at;
}

}  // namespace touchstone::stats
