// Case files of what an algorithm answered wrongly.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/check/tally.h"

namespace touchstone::check {

struct FailureCase {
  grade::GradedAnswer answer;  // of the case as it is in the file
  std::string id;              // of the case that it was shrunk from
  std::string what;            // is wrong with the answer, in words
  std::filesystem::path file;

  // That shows it again.
  std::string command(const CheckRequest& request) const;
};

// One of ours that answers a case and another form of it differently.
struct VariantFailure {
  grade::Query query;
  std::string id;  // of the first such case
  VariantCount count;
  std::filesystem::path file;  // the case and its other form
};

// A case whose proof was refused, or a box of a body that does not hold it.
struct TruthFailure {
  JobSummary job;
  std::string id;  // of the first such case
  std::filesystem::path file;
};

// That shows the cases of a file again.
std::string query_command(const CheckRequest& request, const grade::Query& query,
                          const std::filesystem::path& file);

// Writes the cases of these answers, each shrunk as far as it still fails in the same way, into the
// request's folder: failures/ALGORITHM-SCALAR-TASK.jsonl, one case a line. Case files of an earlier
// check there are removed first.
std::vector<FailureCase> write_failures(const CheckRequest& request,
                                        const std::vector<grade::GradedAnswer>& failures);
// The same for failures/ALGORITHM-SCALAR-TASK-variants.jsonl and failures/truth.jsonl, not shrunk.
// After write_failures.
std::vector<VariantFailure> write_variant_failures(const CheckRequest& request, const Tally& tally);
std::vector<TruthFailure> write_truth_failures(const CheckRequest& request, const Tally& tally);

}  // namespace touchstone::check
