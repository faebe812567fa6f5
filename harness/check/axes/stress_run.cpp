// Runs all cells of a sweep and writes its files.
#include "harness/check/axes/stress_run.h"

#include <fmt/format.h>

#include <utility>

#include "harness/base/progress.h"
#include "harness/check/axes/worst_cases.h"
#include "harness/check/families/family_failures.h"
#include "harness/check/families/family_rows.h"
#include "harness/check/job_folder.h"

namespace touchstone::check {
namespace {

enum : std::size_t { rows_file, cells_file, families_file };

// Returns true if an interrupt ended them.
bool do_all_jobs(const StressRequest& request, record::ResultFolder& folder) {
  const base::UnitRange jobs = request.jobs(static_cast<std::int64_t>(request.job_count()));
  if (folder.units() >= jobs.size()) return false;
  base::Progress progress(static_cast<std::size_t>(jobs.size() - folder.units()));
  return do_jobs<CellResult>(
      folder, request, jobs,
      [&](std::size_t job, oracle::Oracle& oracle) { return do_stress_job(request, job, oracle); },
      [&](std::size_t job, const CellResult& result) {
        if (job >= request.cells.size()) {
          for (const FamilyCount& count : result.families) {
            folder.write(families_file, count, request.subjects());
          }
          progress.start(request.families[job - request.cells.size()]->name);
          return true;
        }
        for (const StressRow& row : result.rows) folder.write(rows_file, row, request);
        folder.write(cells_file, result.summary, request);
        const StressCell& done = request.cells[job];
        progress.start(fmt::format("{} {}", done.axis->name, done.value().name));
        return true;
      });
}

}  // namespace

record::ResultFolderPlan stress_folder(const StressRequest& request) {
  std::string axes;
  for (const StressCell& cell : request.cells) {
    if (cell.place == 0) axes += (axes.empty() ? "" : " ") + cell.axis->name;
  }
  for (const kinds::Family* family : request.families) axes += " " + family->name;
  return job_folder(request, "sweep", {"axes", axes},
                    {{"stress.csv", record::header_of<StressRow>(request)},
                     {"cells.csv", record::header_of<CellSummary>(request)},
                     {"families.csv", record::header_of<FamilyCount>(request.subjects())}});
}

StressResult run_stress(const StressRequest& request) {
  record::ResultFolder folder(stress_folder(request));
  StressResult result;
  result.interrupted = do_all_jobs(request, folder);
  if (result.interrupted) return result;
  folder.finish();
  if (request.part) return result;
  // Rows come from the files, so that a resumed sweep has the same result as a whole one.
  result.rows = folder.rows<StressRow>(rows_file, request);
  result.cells = folder.rows<CellSummary>(cells_file, request);
  result.reaches = envelope(request, result.rows);
  result.broken = broken_promises(request, result.rows);
  write_envelope(request, result.reaches, request.out / "envelope.csv");
  result.failures = write_failures(request.as_check(), worst_cases(request, result.rows));
  folder.each_row<FamilyCount>(
      families_file, [&](const FamilyCount& count) { add_to(result.families, count); },
      request.subjects());
  const auto wrong = write_family_failures(request, result.families);
  for (std::string& line : broken_family_promises(request, wrong)) {
    result.broken.push_back(std::move(line));
  }
  return result;
}

}  // namespace touchstone::check
