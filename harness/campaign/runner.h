// Runs a campaign.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/campaign/campaign.h"
#include "harness/record/findings.h"
#include "harness/record/part.h"
#include "harness/record/result_folder.h"

namespace touchstone::campaign {

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
                       const std::optional<record::Part>& part = {});

// Runs the check pass of every block alone: the campaign's answers, without samples and files.
record::Findings check_campaign(const Campaign& campaign);

}  // namespace touchstone::campaign
