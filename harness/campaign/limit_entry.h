// The lower bound of algorithms/limit.h as a contestant of a block.
#pragma once

#include "algorithms/broad_phase.h"
#include "harness/measure/block_input.h"

namespace touchstone {

// Measured like the broad phases of the block, and named stats::limit_label in its rows; it "finds"
// the pairs that the input holds. Only for the boxes of this input, which outlives it.
BroadPhaseEntry limit_entry(const BlockInput& input);

}  // namespace touchstone
