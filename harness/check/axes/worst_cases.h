// The cases of a sweep that are worth a file.
#pragma once

#include <span>
#include <vector>

#include "harness/check/axes/stress_row.h"
#include "harness/check/failures.h"

namespace touchstone::check {

// Of ours in double every axis on which a task is silently wrong or lost, at its first value; of a
// peer in a scalar the worst silent errors of three axes, and one query that it crashes or hangs
// in. Hulls of more than a hundred vertices are left out. Each is asked again, since only that it
// failed is known.
std::vector<grade::GradedAnswer> worst_cases(const StressRequest& request,
                                             std::span<const StressRow> rows);

}  // namespace touchstone::check
