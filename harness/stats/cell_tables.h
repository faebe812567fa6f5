// The tables of a cell run, and what threads bring in cells that differ in them alone.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/stats/cell_results.h"

namespace touchstone::stats {

// A row for each algorithm that is right and was timed in a cell whose name ends with "2 threads", or more, and in
// the cell of the same name for one. These share their squares.
std::vector<CellSpeedUpRow> cell_speed_ups(std::span<const CellTimes> cells);

// Writes set_times.csv, set_best.csv and tables.md into `out` from the rows in the folder, and set_speed_ups.csv where cells
// differ in threads alone, and returns a summary for the screen. Throws InputError with file and line.
std::string write_cell_tables(const std::filesystem::path& folder, const std::string& name,
                              const std::filesystem::path& out);

}  // namespace touchstone::stats
