// Cost estimate of a block's check pass.
#pragma once

#include <cstddef>
#include <span>

#include "harness/campaign/run_context.h"
#include "harness/measure/phases/block_input.h"

namespace touchstone::campaign {

// Seconds, about: from checking the first frames and some pairs of each set, in child processes and
// without leaving a file. `frames`: how many there are, where the input has only the first ones.
double price_of_check(const RunContext& context, const measure::BlockInput& input,
                      std::size_t frames, std::span<const measure::NarrowSet> sets);

}  // namespace touchstone::campaign
