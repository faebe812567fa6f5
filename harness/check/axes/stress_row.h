// A row of stress.csv: the answers of one algorithm to one task in one cell, counted.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/check/axes/stress_outcome.h"
#include "harness/check/axes/stress_request.h"
#include "harness/files/csv.h"

namespace touchstone {

// Plain bytes, so that a worker can send it.
struct StressRow {
  std::uint32_t cell = 0, entry = 0;  // places in the request
  Precision scalar{};
  Task task{};
  std::array<std::int32_t, all_stress_outcomes.size()> counts{};
  std::int32_t skipped = 0;       // not asked, after too many crashes and hangs
  double margin = Outcome::none;  // the greatest of the cell: see wrong_margin and worst_error
  double error = Outcome::none;
  // Indices of cases, -1 where there is none: of the silent error that is furthest off, and of the
  // first query that crashed or hung.
  std::int64_t worst = -1;
  std::int64_t lost = -1;

  std::int32_t count(StressOutcome outcome) const {
    return counts[static_cast<std::size_t>(outcome)];
  }
  std::int32_t answers() const;  // that were asked for and graded
  void add(StressOutcome outcome) { ++counts[static_cast<std::size_t>(outcome)]; }
};

std::vector<std::string> stress_header();
void write(CsvWriter& file, const StressRow& row, const StressRequest& request);
// InputError where a name is none of the request's.
StressRow read_stress_row(const CsvReader::Row& row, const StressRequest& request);

}  // namespace touchstone
