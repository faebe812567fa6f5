#include "harness/check/axes/stress_run.h"

#include <fmt/format.h>

#include <memory>
#include <system_error>

#include "harness/base/error.h"
#include "harness/base/progress.h"
#include "harness/check/axes/stress_files.h"
#include "harness/check/axes/worst_cases.h"
#include "harness/process/worker_pool.h"
#include "harness/record/machine.h"

namespace touchstone {
namespace {

void do_cells(const StressRequest& request, StressFiles& files) {
  const std::size_t end = request.cells.size();
  if (files.cells() >= end) return;
  Progress progress(end - files.cells());
  run_jobs(
      files.cells(), end, request.workers,
      [&]() -> JobWork {
        // One oracle for each process: it keeps its memory from query to query.
        const auto oracle = std::make_shared<oracle::Oracle>();
        return
            [&request, oracle](std::size_t cell) { return pack(do_cell(request, cell, *oracle)); };
      },
      [&](std::size_t cell, const std::string& bytes) {
        files.write(unpack_cell(bytes));
        const StressCell& done = request.cells[cell];
        progress.start(fmt::format("{} {}", done.axis->name, done.value().name));
        return true;
      });
}

}  // namespace

StressResult run_stress(const StressRequest& request) {
  std::error_code error;
  if (!request.resume) std::filesystem::create_directories(request.out, error);
  if (error) throw InputError(request.out.string(), 0, "cannot be made: " + error.message());
  StressFiles files(request);
  write_facts({{"stress", request.resume ? "resumed" : "whole"},
               {"seed", std::to_string(request.seed)},
               {"cases", std::to_string(request.cases)},
               {"time_limit", fmt::format("{}", request.time_limit)}},
              request.out / "machine.csv");
  do_cells(request, files);
  files.close();
  StressResult result;
  // From the files, so that a sweep that was gone on with tells the same as a whole one.
  result.rows = read_stress_rows(request);
  result.cells = read_cell_summaries(request);
  result.reaches = envelope(request, result.rows);
  result.broken = broken_promises(request, result.rows);
  write_envelope(request, result.reaches, request.out / "envelope.csv");
  result.failures = write_failures(request.as_check(), worst_cases(request, result.rows));
  return result;
}

}  // namespace touchstone
