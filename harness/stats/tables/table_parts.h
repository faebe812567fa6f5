// The parts of which make_tables makes the tables.
#pragma once

#include <optional>
#include <vector>

#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

inline constexpr double confidence = 0.95;

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
