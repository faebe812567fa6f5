#include "harness/check/check_run.h"

#include <fmt/format.h>

#include <limits>
#include <system_error>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/progress.h"
#include "harness/check/check_files.h"
#include "harness/check/check_job.h"
#include "harness/process/worker_pool.h"
#include "harness/record/machine.h"

namespace touchstone {
namespace {

constexpr double broad_seconds = 20;  // that a broad phase may take over a scene

void grade_all(const CheckRequest& request, CheckFiles& files, Tally& tally) {
  const std::size_t regimes = request.regimes.size();
  const bool endless = request.seconds > 0;
  const std::size_t end = endless ? std::numeric_limits<std::size_t>::max() : regimes;
  if (files.jobs() >= end) return;
  const Stopwatch watch;
  Progress progress(endless ? 1 : end - files.jobs());
  if (endless) progress.start(fmt::format("checking for {:g} s", request.seconds));
  run_jobs(
      files.jobs(), end, request.workers,
      [&]() -> JobWork {
        // One oracle for each process: it keeps its memory from query to query.
        const auto oracle = std::make_shared<oracle::Oracle>();
        return [&request, oracle](std::size_t job) { return pack(do_job(request, job, *oracle)); };
      },
      [&](std::size_t job, const std::string& bytes) {
        const JobResult result = unpack(bytes);
        files.write(result);
        for (const GradedAnswer& answer : result.answers) tally.add(answer);
        for (const VariantCount& count : result.variants) tally.add(result.summary.regime, count);
        tally.add(result.summary);
        if (!endless) {
          progress.start(request.regimes[job % regimes]->name);
          return true;
        }
        progress.part(watch.seconds() / request.seconds);
        return watch.seconds() < request.seconds;
      });
}

}  // namespace

std::unique_ptr<CheckResult> run_check(const CheckRequest& request) {
  std::error_code error;
  if (!request.resume) std::filesystem::create_directories(request.out, error);
  if (error) throw InputError(request.out.string(), 0, "cannot be made: " + error.message());
  auto result = std::make_unique<CheckResult>();
  result->report.request = &request;
  result->report.tally = &result->tally;
  CheckFiles files(request, result->tally);
  write_facts({{"check", request.resume ? "resumed" : "whole"},
               {"seed", std::to_string(request.seed)},
               {"cases", std::to_string(request.cases)}},
              request.out / "machine.csv");
  if (!request.narrow.empty()) grade_all(request, files, result->tally);
  files.close();
  if (!request.broad.empty()) result->scenes = box_scenes(request.seed);
  result->report.failures = write_failures(request, result->tally);
  result->report.variant_failures = write_variant_failures(request, result->tally);
  result->report.truth_failures = write_truth_failures(request, result->tally);
  result->report.broad = check_broad_phases(request.broad, result->scenes, broad_seconds);
  write_summary(result->report, request.out / "summary.csv");
  return result;
}

}  // namespace touchstone
