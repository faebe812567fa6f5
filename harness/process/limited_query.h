// Queries that may crash or hang: each with its own time limit, or those of a batch one by one in a
// child process.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/narrow_phase.h"
#include "algorithms/registry.h"
#include "harness/files/cases.h"

namespace touchstone::process {

struct LimitedQuery {
  const files::Case* pair;
  Task task;
};

struct QueryLimits {
  // Processor time of one query; other load on the machine does not count. A query that waits
  // instead has twenty times as long by the wall clock, twice.
  double seconds = 0.5;
  std::size_t lost = 3;  // the number of crashes and hangs after which the rest is skipped
};

// Returns the outcome of each query, run in a child process; crashed and timed_out are statuses.
// The algorithm is made and given its shapes for each case alone (see solve_case.h). Binding large
// hulls takes longer than a query. So, if there are any, all shapes are bound before the queries,
// within three seconds of processor time.
std::vector<Outcome> ask_limited(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                                 const std::vector<LimitedQuery>& queries,
                                 const QueryLimits& limits);

// Returns whether the query was skipped because too many before it were lost.
bool is_not_asked(const Outcome& outcome);

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
