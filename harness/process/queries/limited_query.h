// Queries that may crash or hang, each with its own time limit.
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

}  // namespace touchstone::process
