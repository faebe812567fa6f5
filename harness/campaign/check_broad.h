// The check pass of a broad phase: every frame, against the true pairs, at one thread.
#pragma once

#include <span>
#include <vector>

#include "harness/campaign/blocks.h"
#include "harness/measure/block_input.h"

namespace touchstone::campaign {

// Plays the scene in a child process and writes a row for each frame and phase, and a departure for
// each frame whose pairs are not the true ones. On request it returns the found pairs of each
// frame; all are there if the algorithm reached the end.
struct CheckedBroad {
  bool whole = false;  // true if it reached the end
  bool right = false;  // true if it also found the true pairs
  std::vector<std::vector<IndexPair>> pairs;
};
CheckedBroad check_broad(const RunContext& context, const measure::BlockInput& input,
                         const BroadPhaseEntry& entry, bool with_pairs);

}  // namespace touchstone::campaign
