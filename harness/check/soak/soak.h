// Counts verdicts by the million, of each algorithm against the exact answers.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "harness/check/check_request.h"
#include "harness/check/families/family_count.h"
#include "harness/check/families/family_failures.h"
#include "harness/record/result_folder.h"

namespace touchstone::check {

// The request of a soak. `broad`, `cases` and `seconds` are not read.
struct SoakRequest : CheckRequest {
  std::int64_t pairs = 1'000'000;  // cases in all, spread evenly over the regimes and families
};

// Counts of one algorithm in one scalar in one regime.
struct SoakCount {
  std::int64_t pairs = 0;  // pairs of kinds that it takes
  // Exact answers of these pairs; `unresolved` are curved bodies that the oracle leaves open.
  std::int64_t separated = 0, touching = 0, overlapping = 0, unresolved = 0;
  std::int64_t silent = 0;  // wrong side of contact, with status ok or none
  std::int64_t honest =
      0;  // gave up: the answer is unknown, or the status says that it is not to be trusted
  std::int64_t lost = 0;          // failed: crashed, or gave no answer in time
  std::int64_t first_wrong = -1;  // index of the first case that was silently wrong or failed

  void add(const SoakCount& other);
};

// The pairs of a job.
inline constexpr std::int64_t cases_a_soak_job = 1000;

// Returns the folder that run_soak fills, and the number of its jobs.
record::ResultFolderPlan soak_folder(const SoakRequest& request);
inline std::int64_t jobs_of(const SoakRequest& request) {
  return (request.pairs + cases_a_soak_job - 1) / cases_a_soak_job;
}

struct SoakResult {
  // The key has places in the request's narrow phases and regimes.
  using Key = std::tuple<std::size_t, Precision, std::size_t>;
  std::map<Key, SoakCount> counts;
  FamilyCounts families;
  std::vector<FamilyFailure> failures;  // of families
  std::int64_t drawn = 0;    // pairs of all kinds, whether an algorithm takes them or not
  bool interrupted = false;  // rows are kept, and nothing is made of them

  bool ours_are_wrong(const SoakRequest& request) const;
};

// Counts verdicts and writes jobs.csv, families.csv, soak.csv, progress.csv and machine.csv into the request's
// folder, which it creates, and a case file of the first wrong answer of each count. soak.csv, the
// sum of jobs.csv, is rewritten about once a second. Progress goes to standard error. A part has
// jobs.csv, families.csv, progress.csv and machine.csv alone; an interrupt ends it after the current job. Throws
// InputError if the folder cannot be written or resumed.
SoakResult run_soak(const SoakRequest& request);

}  // namespace touchstone::check
