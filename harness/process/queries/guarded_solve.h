// A narrow phase run pair by pair where it can do no harm, to find the pair that it fails on.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "algorithms/narrow_phase.h"

namespace touchstone::process {

// Answers the batch pair by pair in a child process, where `make` gives the algorithm with its
// shapes bound. A query that kills the child gets the status crashed; one that takes longer than
// `time_limit` seconds gets timed_out, and so does what is left when all queries together have
// taken that long. After three lost queries the rest shares the status of the last.
void solve_guarded(const std::function<std::unique_ptr<NarrowPhase>()>& make, Task task,
                   const PairBatch& batch, std::span<Outcome> outcomes, double time_limit,
                   std::size_t memory_limit);

}  // namespace touchstone::process
