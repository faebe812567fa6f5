// The lower bound of algorithms/limit.h as a broad phase of a block.
#pragma once

#include "algorithms/broad_phase.h"
#include "harness/measure/phases/block_input.h"

namespace touchstone::campaign {

// It is measured like the broad phases of the block, named stats::limit_label in its rows, and
// "finds" the pairs that the input holds. It works only with the boxes of this input, which
// outlives it.
BroadPhaseEntry lower_bound_entry(const measure::BlockInput& input);

}  // namespace touchstone::campaign
