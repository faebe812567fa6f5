// A whole stress sweep, from the request to its files.
#pragma once

#include <string>
#include <vector>

#include "harness/check/axes/envelope.h"
#include "harness/check/axes/stress_cell.h"
#include "harness/check/failures.h"
#include "harness/check/families/family_count.h"
#include "harness/record/result_folder.h"

namespace touchstone::check {

struct StressResult {
  std::vector<StressRow> rows;
  std::vector<CellSummary> cells;
  std::vector<Reach> reaches;
  std::vector<FailureCase> failures;
  FamilyCounts families;
  std::vector<std::string> broken;  // see broken_promises
  bool interrupted = false;         // rows are kept, and nothing is made of them
};

// Returns the folder that run_stress fills; it has a job for each cell and family.
record::ResultFolderPlan stress_folder(const StressRequest& request);

// Runs all queries and writes stress.csv, cells.csv, families.csv, progress.csv, envelope.csv, machine.csv and
// failures/ into the request's folder, which it creates. Progress goes to standard error. A part
// has the rows and machine.csv alone, and an empty result; an interrupt ends it after the current
// cell. Throws InputError if the folder cannot be written or resumed. The request must outlive the
// result.
StressResult run_stress(const StressRequest& request);

// Returns the text for the terminal.
std::string stress_text(const StressRequest& request, const StressResult& result,
                        std::size_t page_width);

// Returns the Markdown page of the first failures. `command` is the command that made it.
// `pictures` is the path of the maps from the page's folder; if it is empty, the page has no maps.
std::string stress_page(const StressRequest& request, const StressResult& result,
                        const std::string& command, const std::string& pictures);

}  // namespace touchstone::check
