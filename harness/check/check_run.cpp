// Runs the jobs of a check, tallies their results and writes the files.
#include "harness/check/check_run.h"

#include <fmt/format.h>

#include <limits>

#include "harness/base/clock.h"
#include "harness/base/progress.h"
#include "harness/check/check_job.h"
#include "harness/check/check_rows.h"
#include "harness/check/families/family_failures.h"
#include "harness/check/families/family_rows.h"
#include "harness/check/job_folder.h"

namespace touchstone::check {
namespace {

constexpr double broad_seconds = 20;  // time limit of a broad phase for a scene

enum : std::size_t { grades_file, variants_file, jobs_file, families_file };

// Counts the rows of an interrupted check.
void take_up(const record::ResultFolder& folder, const CheckSubjects& subjects, Tally& tally) {
  const auto add = [&](const auto& row) { tally.add(row); };
  folder.each_row<grade::GradedAnswer>(grades_file, add, subjects);
  folder.each_row<VariantCount>(variants_file, add, subjects);
  folder.each_row<JobSummary>(jobs_file, add, subjects);
  folder.each_row<FamilyCount>(families_file, add, subjects);
}

// Returns true if an interrupt ended it.
bool grade_all(const CheckRequest& request, record::ResultFolder& folder, Tally& tally) {
  const bool endless = request.seconds > 0;
  const base::UnitRange jobs =
      request.jobs(endless ? std::numeric_limits<std::int64_t>::max() : jobs_of(request));
  if (folder.units() >= jobs.size()) return false;
  const CheckSubjects subjects = request.subjects();
  const base::Stopwatch watch;
  base::Progress progress(endless ? 1 : static_cast<std::size_t>(jobs.size() - folder.units()));
  if (endless) progress.start(fmt::format("checking for {:g} s", request.seconds));
  const auto keep = [&](std::size_t file, const auto& row) {
    folder.write(file, row, subjects);
    tally.add(row);
  };
  return do_jobs<JobResult>(
      folder, request, jobs,
      [&](std::size_t job, oracle::Oracle& oracle) { return do_job(request, job, oracle); },
      [&](std::size_t job, const JobResult& result) {
        for (const grade::GradedAnswer& answer : result.answers) keep(grades_file, answer);
        for (const VariantCount& count : result.variants) keep(variants_file, count);
        for (const FamilyCount& count : result.families) keep(families_file, count);
        const std::size_t place = job % request.period();
        const bool is_family = place >= request.regime_jobs();
        if (!is_family) keep(jobs_file, result.summary);
        if (!endless) {
          progress.start(is_family ? request.families[place - request.regime_jobs()]->name
                                   : request.regimes[place]->name);
          return true;
        }
        progress.part(watch.seconds() / request.seconds);
        return watch.seconds() < request.seconds;
      });
}

}  // namespace

record::ResultFolderPlan check_folder(const CheckRequest& request) {
  const CheckSubjects subjects = request.subjects();
  return job_folder(request, "check", regimes_fact(request),
                    {{"grades.csv", record::header_of<grade::GradedAnswer>(subjects)},
                     {"variants.csv", record::header_of<VariantCount>(subjects)},
                     {"jobs.csv", record::header_of<JobSummary>(subjects)},
                     {"families.csv", record::header_of<FamilyCount>(subjects)}});
}

std::int64_t jobs_of(const CheckRequest& request) {
  return static_cast<std::int64_t>(request.period()) * request.rounds;
}

std::unique_ptr<CheckResult> run_check(const CheckRequest& request) {
  auto result = std::make_unique<CheckResult>();
  result->report.request = &request;
  result->report.tally = &result->tally;
  record::ResultFolder folder(check_folder(request));
  if (request.resume) take_up(folder, request.subjects(), result->tally);
  if (request.period() > 0) result->interrupted = grade_all(request, folder, result->tally);
  if (result->interrupted) return result;
  folder.finish();
  if (request.part) return result;
  if (!request.broad.empty()) result->scenes = box_scenes(request.seed);
  result->report.failures = write_failures(request, result->tally.failures(request));
  result->report.variant_failures = write_variant_failures(request, result->tally);
  result->report.truth_failures = write_truth_failures(request, result->tally);
  result->report.family_failures = write_family_failures(request, result->tally.families());
  result->report.broad = check_broad_phases(request.broad, result->scenes, broad_seconds);
  write_summary(result->report, request.out / "summary.csv");
  return result;
}

}  // namespace touchstone::check
