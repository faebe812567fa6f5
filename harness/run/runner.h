// Runs a campaign.
#pragma once

#include <filesystem>

#include "harness/run/campaign.h"
#include "harness/run/findings.h"

namespace touchstone {

// Loads every scene first, so that a wrong one is told before anything is written (InputError).
// Then runs block after block, writing rows to DIR/raw.csv as they are measured, DIR/machine.csv,
// and a file into DIR/reproductions for each departure. An interrupt (SIGINT) ends the run after
// the frame at hand; what was measured is kept.
struct RunResult {
  Findings findings;
  bool interrupted = false;
};
RunResult run_campaign(const Campaign& campaign, const std::filesystem::path& folder);

}  // namespace touchstone
