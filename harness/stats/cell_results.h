// What a cell run measured, cell by cell, and its rows as results that can be compared with
// another's.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/stats/cell_rows.h"
#include "harness/stats/samples.h"

namespace touchstone::stats {

struct CellTimes {
  std::pair<std::string, std::string> name;       // group, cell
  std::vector<CellTimeRow> rows;                  // in the order of the grades
  std::map<std::string, Contestant> contestants;  // with their samples, by algorithm
  Contestant twin;                                // the second registration of the baseline
  Noise noise = Noise::left_out;                  // of the samples that count
  std::optional<CellBestRow> best;
};

// Reads set_grades.csv and raw.csv. Throws InputError with file and line.
std::vector<CellTimes> read_cell_times(const std::filesystem::path& folder);

// Adds the sample of a row of a timed set, or its failure.
void add_sample(Contestant& contestant, const record::RawRow& row);

// Whether the folder, or the raw.csv in it, is of a cell run.
bool is_of_cells(const std::filesystem::path& folder_or_file);

// Reads set_grades.csv, raw.csv and machine.csv. A cell is a set whose scene is named "group, cell" and has
// the hash of the cells' file; a grade is the check of a contestant. Throws
// InputError with file and line.
Results read_cell_results(const std::filesystem::path& folder_or_file);

}  // namespace touchstone::stats
