// What a cell run measured, cell by cell.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/stats/cells/cell_rows.h"

namespace touchstone::stats {

inline constexpr double cell_confidence = 0.95;

struct CellTimes {
  std::pair<std::string, std::string> name;             // group, cell
  std::vector<CellTimeRow> rows;                        // in the order of the grades
  std::map<std::string, std::vector<double>> by_round;  // seconds of each algorithm
  std::optional<CellBestRow> best;
};

// Reads grades.csv and raw.csv. Throws InputError with file and line.
std::vector<CellTimes> read_cell_times(const std::filesystem::path& folder);

}  // namespace touchstone::stats
