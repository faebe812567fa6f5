// Runs timed sets: grades every algorithm, then times them in squares of the measuring loop.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/kinds/timed_set.h"
#include "harness/record/machine.h"
#include "harness/record/result_folder.h"

namespace touchstone::cells {

struct CellRequest {
  std::string name;
  std::string query_kind;  // `ray`, `point`, ... `motion`, `frames`: in rows
  std::vector<kinds::PlannedSet> cells;
  // Samples of a contestant, about: at least 6, in as many squares, from which on there are intervals.
  int rounds = 12;
  double sample_seconds = 0.01;  // a sample repeats the cell for about this long
  // Seconds; an algorithm that needs more for a set is not timed in it, and a sample that takes longer
  // than planned by as much is stopped.
  double time_limit = 20;
  std::uint64_t seed = 1;  // of the order in the rounds
  record::Facts identity;  // what decides the cells
};

struct CellRunResult {
  bool interrupted = false;
  bool ours_wrong = false;
};

// Fills the folder with set_grades.csv, raw.csv and machine.csv. An algorithm is graded in a process apart
// and timed in workers of its own, so that a crash or a hang costs it alone. A run that was stopped goes
// on behind its last whole round. `say` gets a line for each set. Throws InputError as ResultFolder does.
CellRunResult run_cells(const CellRequest& request, const std::filesystem::path& folder,
                        record::FolderStart start,
                        const std::function<void(const std::string&)>& say);

}  // namespace touchstone::cells
