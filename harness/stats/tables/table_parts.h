// The parts of which make_tables makes the tables.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

using TakesPart = std::function<bool(const Contestant&)>;

// Returns the fastest of those that take part, by the ratio of each to the baseline in its own
// squares, without those that failed; null if there is none.
const Contestant* fastest(const SampleSet& set, Noise noise, const TakesPart& takes_part);

// Returns true if one that takes part was timed and disturbed in every square, and may be as fast as
// `best`: then nobody knows who is the fastest. Noise only adds, but hardly triples every sample.
bool is_any_unheard(const SampleSet& set, const Contestant& best, Noise noise,
                    const TakesPart& takes_part);

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

// Returns nothing for a contestant that was not asked, or whose work was not counted.
std::optional<AgreementRow> agreement_row(const SampleSet& set, const Contestant& contestant);
std::optional<WorkRow> work_row(const SampleSet& set, const Contestant& contestant);

std::vector<ExponentRow> exponent_rows(const std::vector<TimeRow>& times);
std::vector<SpeedUpRow> speed_up_rows(const Results& results, Noise noise);
std::vector<ExecutorRow> executor_rows(const Results& results, Noise noise);

// These functions need the other tables of the same results.
std::vector<BroadBestRow> broad_best(const Results& results, Noise noise, const Tables& tables);
std::vector<NarrowBestRow> narrow_best(const Results& results, Noise noise, const Tables& tables);

}  // namespace touchstone::stats
