// A whole check, from the request to its files.
#pragma once

#include <cstdint>

#include "harness/check/check_report.h"
#include "harness/record/result_folder.h"

namespace touchstone::check {

// Returns the folder that run_check fills.
record::ResultFolderPlan check_folder(const CheckRequest& request);

// Does all jobs, and writes into the request's folder, which it creates: the rows of the checkers,
// progress.csv, machine.csv, failures/, and of cases summary.csv, of axes envelope.csv, of counts soak.csv.
// soak.csv, the sum of jobs.csv, is rewritten about once a second. Progress goes to standard
// error. A part has the rows and machine.csv alone, and no failures in its report; an interrupt ends it
// after the current job. Throws InputError if the folder cannot be written or resumed. The request must
// outlive the report.
CheckReport run_check(const CheckRequest& request);

}  // namespace touchstone::check
