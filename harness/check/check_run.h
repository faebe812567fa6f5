// A whole check, from the request to its files.
#pragma once

#include <memory>
#include <vector>

#include "harness/check/check_report.h"
#include "harness/check/tally.h"

namespace touchstone::check {

// The result owns all that its report refers to, except the request.
struct CheckResult {
  Tally tally;
  std::vector<BoxScene> scenes;
  CheckReport report;
};

// Grades everything and writes grades.csv, variants.csv, jobs.csv, progress.csv, summary.csv,
// machine.csv and failures/ into the request's folder, which it creates. Progress goes to standard
// error. Throws InputError if the folder cannot be written or resumed.
std::unique_ptr<CheckResult> run_check(const CheckRequest& request);

}  // namespace touchstone::check
