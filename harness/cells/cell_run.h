// Runs cells: grades every algorithm, then times them in shuffled rounds.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/kinds/timed_set.h"
#include "harness/record/facts.h"
#include "harness/record/result_folder.h"

namespace touchstone::cells {

struct CellRequest {
  std::string name;
  std::vector<kinds::PlannedSet> cells;
  int rounds = 12;               // at least 6, from which on there are intervals
  double sample_seconds = 0.01;  // a sample repeats the cell for about this long
  double time_limit = 20;  // seconds; an algorithm that needs more for a cell is not timed in it
  std::uint64_t seed = 1;  // of the order in the rounds
  record::Facts identity;  // what decides the cells
};

struct CellRunResult {
  bool interrupted = false;
  bool ours_wrong = false;
};

// Fills the folder with grades.csv, raw.csv and machine.csv. An algorithm is graded in a process of its
// own, so that a crash costs its row alone. `say` gets a line for each cell. Throws InputError as
// ResultFolder does.
CellRunResult run_cells(const CellRequest& request, const std::filesystem::path& folder,
                        record::FolderStart start,
                        const std::function<void(const std::string&)>& say);

}  // namespace touchstone::cells
