// A narrow phase of somebody else's, run where it can do no harm.
#pragma once

#include <span>

#include "algorithms/narrow_phase.h"

namespace touchstone {

// Like algorithm.solve(batch, outcomes), pair by pair in a child process. A query that kills the
// child gets the status crashed; one that takes longer than `time_limit` seconds gets timed_out,
// and so does what is left when all queries together have taken that long. After three lost queries
// the rest shares the status of the last.
void solve_guarded(NarrowPhase& algorithm, const PairBatch& batch, std::span<Outcome> outcomes,
                   double time_limit);

}  // namespace touchstone
