// The plan of a campaign: its blocks, their contestants and the time that they take.
#pragma once

#include <string>
#include <vector>

#include "harness/campaign/campaign.h"

namespace touchstone::campaign {

// The plan of run_campaign for a block, with its time, by trials of a few frames and pairs.
struct PlannedBlock {
  std::string label;  // a label such as "uniform, 1000 bodies, 64 frames, tight boxes, 2 threads"
  struct Set {
    std::string name;  // a name such as "broad phases" or "intersect box-sphere"
    std::vector<std::string> contestants;
  };
  std::vector<Set> sets;
  double check_seconds = 0;  // approximate time of its check
  double seconds = 0;        // approximate greatest time of its samples
};
std::vector<PlannedBlock> plan_campaign(const Campaign& campaign);

}  // namespace touchstone::campaign
