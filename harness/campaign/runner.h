// Runs a campaign.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/campaign/campaign.h"
#include "harness/record/findings.h"
#include "harness/record/result_folder.h"

namespace touchstone::campaign {

struct RunResult {
  record::Findings findings;
  bool interrupted = false;
};

// Loads every scene first, so that a wrong one is told before anything is written (InputError).
// Then takes block after block: the check pass, then samples, written to DIR/raw.csv as they are
// measured, with DIR/departures.csv, DIR/machine.csv, and a file into DIR/reproductions for each
// departure. An interrupt (SIGINT) ends the run after the round at hand, and what was measured is
// kept, to be resumed. The caller is the only thread of its process (std::logic_error): workers are
// forked from it, so that no Executor of more than one thread has been used in it.
RunResult run_campaign(const Campaign& campaign, const std::filesystem::path& folder,
                       record::FolderStart start = record::FolderStart::fresh);

// The check pass of every block alone: the campaign's answers, without samples and files.
record::Findings check_campaign(const Campaign& campaign);

// What run_campaign would do, and for how long, by trials of a few frames and pairs.
struct PlannedBlock {
  std::string label;  // "uniform, 1000 bodies, 64 frames, tight boxes, 2 threads"
  struct Set {
    std::string name;  // "broad phases", "intersect box-sphere"
    std::vector<std::string> contestants;
  };
  std::vector<Set> sets;
  double check_seconds = 0;  // for its check, about
  double seconds = 0;        // for its samples, about and at most
};
std::vector<PlannedBlock> plan_campaign(const Campaign& campaign);

}  // namespace touchstone::campaign
