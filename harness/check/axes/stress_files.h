// The rows that a stress sweep writes as it goes, and how one that was killed is gone on with.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/check/axes/stress_cell.h"
#include "harness/files/csv.h"

namespace touchstone {

// In the request's folder: stress.csv and cells.csv, to which each cell appends, and progress.csv,
// which says how many cells are done and how long the two files then were, and for which request
// and program. What is behind those lengths is a cell that was interrupted, and is cut off.
class StressFiles {
 public:
  // Begins the files; or, where the request says resume, goes on with them. InputError where there
  // is nothing to go on with, or what is there comes from another request or program.
  explicit StressFiles(const StressRequest& request);

  std::size_t cells() const { return cells_; }  // done so far
  void write(const CellResult& result);         // of the next cell
  void close();

 private:
  std::vector<std::pair<std::string, std::string>> identity() const;
  void resume();
  void note_progress();

  const StressRequest& request_;
  std::filesystem::path rows_path_, cells_path_, progress_path_;
  std::string program_;  // 16 hexadecimal digits over the program's bytes
  std::unique_ptr<CsvWriter> rows_file_, cells_file_;
  std::size_t cells_ = 0;
};

// What a sweep wrote.
std::vector<StressRow> read_stress_rows(const StressRequest& request);
std::vector<CellSummary> read_cell_summaries(const StressRequest& request);

}  // namespace touchstone
