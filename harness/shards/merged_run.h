// Joins the blocks of a campaign that were measured in shards.
#pragma once

#include <filesystem>
#include <span>

#include "harness/shards/work.h"
#include "harness/stats/published.h"

namespace touchstone::shards {

// Writes raw.csv, departures.csv, reproductions/, blocks.csv and machine.csv into the folder, and the
// tables: of each machine in machines/NAME if there are several, with across.csv and
// across.md, the range of their ratios. Rows are streamed; the tables of more than
// `most_rows_of_tables` rows, which would have to fit into memory, are left to the command `tables`.
Merged merge_runs(std::span<const DonePart> parts, const stats::Published& published,
                  const MergeFolder& folder);
inline constexpr std::int64_t most_rows_of_tables = 1'000'000;

}  // namespace touchstone::shards
