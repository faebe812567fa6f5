// The tables of a cell run.
#pragma once

#include <filesystem>
#include <string>

namespace touchstone::stats {

// Writes set_times.csv, set_best.csv and tables.md into `out` from the rows in the folder, and set_speed_ups.csv where cells
// differ in threads alone, and returns a summary for the screen. Throws InputError with file and line.
std::string write_cell_tables(const std::filesystem::path& folder, const std::string& name,
                              const std::filesystem::path& out);

}  // namespace touchstone::stats
