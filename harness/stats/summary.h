// The summary of a run in a few lines, for the screen: winners, faults, files.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "harness/record/findings.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

inline constexpr std::size_t most_summary_lines = 25;

// Returns the fastest of ours against the fastest library for each group of scenes, with the ratio
// and its 95 % interval; the algorithms that were wrong, with their errors; and the paths of the
// files. The text has at most most_summary_lines lines.
std::string summary(const Results& results, const Tables& tables,
                    std::span<const record::Departure> departures,
                    const std::filesystem::path& folder);

}  // namespace touchstone::stats
