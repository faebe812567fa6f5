// The folder of a run: writes its findings to raw.csv and departures.csv, unit by unit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "harness/record/findings.h"
#include "harness/record/result_folder.h"

namespace touchstone::campaign {

// Returns the files of rows of a run: raw.csv and departures.csv, in this order.
std::vector<record::RowFile> run_files();

// A unit of a run is a block's check pass, the start of a worker, or a round.
class RunFolder {
 public:
  // Fills the findings from the folder if the run is resumed.
  RunFolder(std::filesystem::path folder, record::Facts facts, record::FolderStart start,
            record::Findings& findings);

  bool was_finished() const { return folder_.was_finished(); }
  // Appends the new findings, as a unit; does nothing if there are none.
  void commit(const record::Findings& findings);
  void finish() { folder_.finish(); }

 private:
  record::ResultFolder folder_;
  std::size_t rows_ = 0, departures_ = 0;  // numbers written
};

}  // namespace touchstone::campaign
