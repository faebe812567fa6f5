// Runs jobs in several processes and takes their results in order.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "harness/process/bytes.h"

namespace touchstone::process {

// Runs the jobs first, first + 1, ... below `end` in `workers` forked processes. Each process calls
// `make` once, and the function that `make` returns for each of its jobs. The result, any bytes, is
// passed to `take` in this process, in the order of the jobs. When `take` returns false, no further
// job is begun and this result is the last. The caller must have no threads. A worker that throws
// or ends by itself causes a std::runtime_error here that names the job. The workers die with the
// caller.
using JobWork = std::function<std::string(std::size_t job)>;
void run_jobs(std::size_t first, std::size_t end, int workers, const std::function<JobWork()>& make,
              const std::function<bool(std::size_t job, std::string result)>& take);

// Runs jobs whose results are values of bytes.h: `make` returns a function from a job to its
// result.
template <class Result, class Make, class Take>
void run_jobs(std::size_t first, std::size_t end, int workers, const Make& make, const Take& take) {
  run_jobs(
      first, end, workers,
      [&]() -> JobWork {
        return [work = make()](std::size_t job) { return to_bytes<Result>(work(job)); };
      },
      [&](std::size_t job, const std::string& bytes) {
        return take(job, from_bytes<Result>(bytes));
      });
}

}  // namespace touchstone::process
