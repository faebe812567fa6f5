// What every run over regimes shares: a folder that can be resumed, filled by jobs in order.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/check/check_request.h"
#include "harness/process/worker_pool.h"
#include "harness/record/result_folder.h"

namespace touchstone::check {

// The folder of a request. `work` is "check" or "sweep"; `subject` names what it goes over, which
// must be the same to resume, as all of the request but its folder, time and processes must.
record::ResultFolderPlan job_folder(const CheckRequest& request, std::string work,
                                    std::pair<std::string, std::string> subject,
                                    std::vector<record::RowFile> files);

// Does the jobs that the folder does not hold yet, below `end`: work(job, oracle) in a worker, then
// take(job, result) here, in order, which returns false to end the run. Each is a unit of the
// folder.
template <class Result, class Work, class Take>
void do_jobs(record::ResultFolder& folder, const CheckRequest& request, std::size_t end,
             const Work& work, const Take& take) {
  process::run_jobs<Result>(
      static_cast<std::size_t>(folder.units()), end, request.workers,
      [&] {
        // One oracle for each process: it keeps its memory from query to query.
        const auto oracle = std::make_shared<oracle::Oracle>();
        return [&work, oracle](std::size_t job) { return work(job, *oracle); };
      },
      [&](std::size_t job, const Result& result) {
        const bool goes_on = take(job, result);
        folder.commit();
        return goes_on;
      });
}

}  // namespace touchstone::check
