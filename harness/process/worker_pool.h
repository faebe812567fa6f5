// Jobs done by several processes, their results taken in order.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "harness/process/bytes.h"

namespace touchstone::process {

// Runs the jobs first, first + 1, ... below `end` in `workers` forked processes, each of which
// calls `make` once and then its result for each of its jobs. What that returns, any bytes, is
// handed to `take` in this process, in the order of the jobs; when `take` returns false no further
// job is begun and its result is the last. The caller has no threads. A worker that ends by itself,
// or throws, is a std::runtime_error here that names the job; the workers die with the caller.
using JobWork = std::function<std::string(std::size_t job)>;
void run_jobs(std::size_t first, std::size_t end, int workers, const std::function<JobWork()>& make,
              const std::function<bool(std::size_t job, std::string result)>& take);

// The same for results that are any values of bytes.h: `make` returns a function from a job to its
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
