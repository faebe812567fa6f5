// Queries that may crash or never end, each with a limit of its own.
#pragma once

#include <cstddef>
#include <vector>

#include "algorithms/registry.h"
#include "harness/files/cases.h"

namespace touchstone::process {

struct LimitedQuery {
  const files::Case* pair;
  Task task;
};

struct QueryLimits {
  // Of the processor's time that a query may use: what others do on the machine does not make it
  // hang. One that waits instead is given twenty times as long by the clock, twice.
  double seconds = 0.5;
  std::size_t lost = 3;  // after so many that crashed or hung the rest is not asked
};

// The outcome of each, in a child process; crashed and timed_out are statuses. The algorithm is
// made and given its shapes for each case alone (see solve_case.h). For large hulls that takes
// longer than a query, and is given ten seconds and not counted.
std::vector<Outcome> ask_limited(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                                 const std::vector<LimitedQuery>& queries,
                                 const QueryLimits& limits);

// Whether the outcome is of a query that was not asked, after too many that were lost.
bool is_not_asked(const Outcome& outcome);

}  // namespace touchstone::process
