// The folder of a run: its findings as raw.csv and departures.csv.
#pragma once

#include <cstddef>
#include <filesystem>

#include "harness/record/findings.h"
#include "harness/record/result_folder.h"

namespace touchstone::campaign {

// A unit is a block's check pass, a worker's first pass, or a round.
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
