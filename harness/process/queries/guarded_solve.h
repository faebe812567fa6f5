// Runs a narrow phase pair by pair in a child process, to find the pair that it fails on.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "algorithms/narrow_phase.h"

namespace touchstone::process {

// Answers a batch.
using SolveBatch = std::function<void(const PairBatch& batch, std::span<Outcome> outcomes)>;

// Answers the batch pair by pair in a child process; `make` returns the algorithm with its shapes
// bound. A query that kills the child gets the status crashed. A query that takes more than
// `time_limit` seconds gets timed_out, and so do all that remain when the queries together have
// taken that long. After three lost queries the rest gets the status of the last.
void solve_guarded(const std::function<SolveBatch()>& make, const PairBatch& batch,
                   std::span<Outcome> outcomes, double time_limit, std::size_t memory_limit);
void solve_guarded(const std::function<std::unique_ptr<NarrowPhase>()>& make, Task task,
                   const PairBatch& batch, std::span<Outcome> outcomes, double time_limit,
                   std::size_t memory_limit);

}  // namespace touchstone::process
