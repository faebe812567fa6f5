// The resumable folder of a run over regimes, filled by jobs in order.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/check_request.h"
#include "harness/process/interrupt.h"
#include "harness/process/worker_pool.h"
#include "harness/record/result_folder.h"

namespace touchstone::check {

// Returns the names of the request's regimes, as a fact.
std::pair<std::string, std::string> regimes_fact(const CheckRequest& request);

// Describes the folder of a request. `work` is "check", "sweep" or "soak"; `subject` names the
// regimes or axes. To resume, `subject` and the rest of the request must be equal, except `out`,
// `seconds`, `workers` and a soak's `pairs`.
record::ResultFolderPlan job_folder(const CheckRequest& request, std::string work,
                                    std::pair<std::string, std::string> subject,
                                    std::vector<record::RowFile> files);

// Does the jobs of the range that the folder does not hold yet: work(job, oracle) in a worker, then
// take(job, result) here, in order. If `take` returns false the run ends. Each job is a unit of the
// folder. An interrupt ends them after the job at hand. Returns true if it ended them before the last.
template <class Result, class Work, class Take>
bool do_jobs(record::ResultFolder& folder, const CheckRequest& request, base::UnitRange jobs,
             const Work& work, const Take& take) {
  const process::InterruptGuard guard;
  process::run_jobs<Result>(
      static_cast<std::size_t>(jobs.first + folder.units()), static_cast<std::size_t>(jobs.end),
      request.workers,
      [&] {
        // Each process has one oracle, which keeps its memory from query to query.
        const auto oracle = std::make_shared<oracle::Oracle>();
        return [&work, oracle](std::size_t job) { return work(job, *oracle); };
      },
      [&](std::size_t job, const Result& result) {
        const bool goes_on = take(job, result);
        folder.commit();
        return goes_on && !process::InterruptGuard::raised();
      });
  return process::InterruptGuard::raised() && folder.units() < jobs.size();
}

}  // namespace touchstone::check
