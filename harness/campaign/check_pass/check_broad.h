// The check pass of a broad phase: every frame, against the true pairs, at one thread.
#pragma once

#include <span>
#include <vector>

#include "harness/campaign/run_context.h"
#include "harness/measure/phases/block_input.h"

namespace touchstone::campaign {

// Plays the scene in a child process and writes a row a frame and phase, and a departure for each
// frame whose pairs are not the true ones. Pairs of each frame as they were found, where asked for;
// all are there when the algorithm came to the end.
struct CheckedBroad {
  bool whole = false;  // it came to the end
  bool right = false;  // and found the true pairs
  std::vector<std::vector<IndexPair>> pairs;
};
CheckedBroad check_broad(const RunContext& context, const measure::BlockInput& input,
                         const BroadPhaseEntry& entry, bool with_pairs);

}  // namespace touchstone::campaign
