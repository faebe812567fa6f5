// Runs a campaign, and writes its findings to the folder of the run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/campaign.h"
#include "harness/record/findings.h"
#include "harness/record/folder_files.h"
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

struct RunResult {
  record::Findings findings;
  bool interrupted = false;
  std::string stopped_at;  // of an interrupted run, such as "the check of block 3 of 13, city"
};

// Loads every scene first, so that a faulty one is reported before anything is written
// (InputError). Then it takes block after block: the check pass, then samples, written to
// DIR/raw.csv as they are measured, with DIR/departures.csv, DIR/machine.csv, and a file into
// DIR/reproductions for each departure. An interrupt (SIGINT, SIGTERM) ends the run after the
// current round; its results are kept and can be resumed. With `part` only these blocks are run, and
// only their scenes are loaded. The caller is the only thread of its process
// (std::logic_error): workers are forked from it, so no Executor of more than one thread may have
// been used in it.
RunResult run_campaign(const Campaign& campaign, const std::filesystem::path& folder,
                       record::FolderStart start = record::FolderStart::fresh,
                       const std::optional<record::Part>& part = {},
                       const std::function<bool()>& before = {});

// Runs the check pass of every block alone: the campaign's answers, without samples and files.
record::Findings check_campaign(const Campaign& campaign);

}  // namespace touchstone::campaign
