// A part of a soak: the verdicts of all algorithms on cases of one regime.
#pragma once

#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/soak/soak.h"

namespace touchstone::check {

// Does a job and returns a count for each of request.algorithms(). The job's number gives regime
// and round, as in do_job.
std::vector<SoakCount> do_soak_job(const SoakRequest& request, std::size_t job,
                                   oracle::Oracle& oracle);

}  // namespace touchstone::check
