// The rows of a cell run as results that can be compared with another's.
#pragma once

#include <filesystem>

#include "harness/stats/samples.h"

namespace touchstone::stats {

// Whether the folder, or the raw.csv in it, is of a cell run.
bool is_of_cells(const std::filesystem::path& folder_or_file);

// Reads set_grades.csv, raw.csv and machine.csv. A cell is a set whose scene is named "group, cell" and has
// the hash of the cells' file; a grade is the check of a contestant. Throws
// InputError with file and line.
Results read_cell_results(const std::filesystem::path& folder_or_file);

}  // namespace touchstone::stats
