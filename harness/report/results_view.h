// What the page shows of a results folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/files/json_line.h"

namespace touchstone::report {

// Returns the folder if it has tables (CSV files, plain or packed by zstd), else those below it that
// have, in the order of their names. Throws InputError if there is none.
std::vector<std::filesystem::path> folders_with_tables(const std::filesystem::path& folder);

struct ResultsRequest {
  std::filesystem::path folder;  // with tables
  std::string name;              // what the page calls it
  int most_cases = 500;          // of the pairs that somebody got wrong
  double time_limit = 5;         // seconds a query about them
};

// The folder's CSV files as they stand, or stood before they were packed, and the pairs that its
// departures, failures and versions list. What cannot be read is named in "notes".
files::OrderedJson results_view(const ResultsRequest& request);

}  // namespace touchstone::report
