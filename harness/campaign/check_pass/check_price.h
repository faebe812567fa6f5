// A cost estimate of a block's check pass.
#pragma once

#include <cstddef>
#include <span>

#include "harness/campaign/run_context.h"
#include "harness/measure/phases/block_input.h"

namespace touchstone::campaign {

// Returns approximate seconds, from a check of the first frames and some pairs of each set, in
// child processes and without files. `frames` is the number of all frames, if the input has only
// the first ones.
double price_of_check(const RunContext& context, const measure::BlockInput& input,
                      std::size_t frames, std::span<const measure::NarrowSet> sets);

}  // namespace touchstone::campaign
