// What a cell run measured, cell by cell.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/stats/cells/cell_rows.h"
#include "harness/stats/samples.h"

namespace touchstone::stats {

inline constexpr double cell_confidence = 0.95;

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

}  // namespace touchstone::stats
