// A whole stress sweep, from the request to its files.
#pragma once

#include <string>
#include <vector>

#include "harness/check/axes/envelope.h"
#include "harness/check/axes/stress_cell.h"
#include "harness/check/failures.h"

namespace touchstone::check {

struct StressResult {
  std::vector<StressRow> rows;
  std::vector<CellSummary> cells;
  std::vector<Reach> reaches;
  std::vector<FailureCase> failures;
  std::vector<std::string> broken;  // promises of ours in double; a line each
};

// Asks everything and writes stress.csv, cells.csv, progress.csv, envelope.csv, machine.csv and
// failures/ into the request's folder, which is made. Progress goes to standard error. InputError
// where the folder cannot be written, or cannot be gone on with. The request outlives the result.
StressResult run_stress(const StressRequest& request);

// For the terminal.
std::string stress_text(const StressRequest& request, const StressResult& result,
                        std::size_t page_width);

// The Markdown page of where each algorithm breaks. `command` is what made it; the maps are looked
// for where `pictures` (a path from the page's folder) says; empty: without them.
std::string stress_page(const StressRequest& request, const StressResult& result,
                        const std::string& command, const std::string& pictures);

}  // namespace touchstone::check
