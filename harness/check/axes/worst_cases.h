// Selects the cases of a sweep that get a file.
#pragma once

#include <span>
#include <vector>

#include "harness/check/axes/stress_row.h"
#include "harness/check/failures.h"

namespace touchstone::check {

// Returns, for ours in double, one case of each axis on which a task is silently wrong or lost, at
// the first such value; for a peer in a scalar, the worst silent errors of three axes, and one
// query that it crashes or hangs in. Hulls of more than a hundred vertices are left out. Each case
// is run again, since the rows say only that it failed.
std::vector<grade::GradedAnswer> worst_cases(const StressRequest& request,
                                             std::span<const StressRow> rows);

}  // namespace touchstone::check
