// Case files of wrong answers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/kinds/pair/pair_rows.h"

namespace touchstone::kinds {

struct FailureCase {
  grade::GradedAnswer answer;  // answer for the case in the file
  std::string id;              // id of the case before it was shrunk
  std::string what;            // description of the fault
  std::filesystem::path file;

  // Returns the command that reproduces the failure.
  std::string command(const PairRequest& request) const;
};

// An algorithm of ours whose answers for a case and a variant of it differ.
struct VariantFailure {
  grade::Query query;
  std::string id;  // id of the first such case
  VariantCount count;
  std::filesystem::path file;  // the case and its variants of the kind
};

// A case whose certificate was refused, or whose boxes do not contain their body.
struct TruthFailure {
  JobSummary job;
  std::string id;  // id of the first such case
  std::filesystem::path file;
};

// Returns the command that runs the cases of a file again.
std::string query_command(const PairRequest& request, const grade::Query& query,
                          const std::filesystem::path& file);

// A query whose answer was wrong, and the index of its case.
struct WrongQuery {
  grade::Query query;
  std::int64_t index;
};

// Asks these queries again, whose rows have only the places of wrong answers.
std::vector<grade::GradedAnswer> ask_again(const PairRequest& request,
                                           const std::vector<WrongQuery>& found);

// Writes the cases of these answers, each shrunk while it still fails in the same way, to
// failures/ALGORITHM-SCALAR-TASK.jsonl in the request's folder, one case per line.
std::vector<FailureCase> write_failures(const PairRequest& request,
                                        const std::vector<grade::GradedAnswer>& failures);
// Write failures/ALGORITHM-SCALAR-TASK-variants.jsonl for counts that have differences beyond the margins, and
// failures/truth.jsonl; these cases are not shrunk.
std::vector<VariantFailure> write_variant_failures(const PairRequest& request,
                                                   const std::vector<VariantCount>& beyond);
std::vector<TruthFailure> write_truth_failures(const PairRequest& request,
                                               const std::vector<JobSummary>& jobs);

}  // namespace touchstone::kinds
