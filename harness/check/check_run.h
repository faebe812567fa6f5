// A whole check, from the request to its files.
#pragma once

#include <memory>
#include <vector>

#include "harness/check/check_report.h"
#include "harness/check/tally.h"
#include "harness/record/result_folder.h"

namespace touchstone::check {

// The result owns all that its report refers to, except the request.
struct CheckResult {
  Tally tally;
  std::vector<BoxScene> scenes;
  CheckReport report;
  bool interrupted = false;  // rows are kept, and nothing is made of them
};

// Returns the folder that run_check fills, and the number of jobs without `seconds`.
record::ResultFolderPlan check_folder(const CheckRequest& request);
std::int64_t jobs_of(const CheckRequest& request);

// Grades everything and writes grades.csv, variants.csv, jobs.csv, families.csv, progress.csv,
// summary.csv, machine.csv and failures/ into the request's folder, which it creates. Progress goes to standard
// error. A part has the rows and machine.csv alone, and its result no report; an interrupt ends it
// after the current job. Throws InputError if the folder cannot be written or resumed.
std::unique_ptr<CheckResult> run_check(const CheckRequest& request);

}  // namespace touchstone::check
