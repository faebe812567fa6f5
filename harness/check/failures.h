// Case files of wrong answers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/check/tally.h"

namespace touchstone::check {

struct FailureCase {
  grade::GradedAnswer answer;  // answer for the case in the file
  std::string id;              // id of the case before it was shrunk
  std::string what;            // description of the fault
  std::filesystem::path file;

  // Returns the command that reproduces the failure.
  std::string command(const CheckRequest& request) const;
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

// A contestant that is wrong about cases of a family.
struct FamilyFailure {
  FamilyCount count;
  std::string command;  // asks for the first such case again
};

// Returns the command that runs the cases of a file again.
std::string query_command(const CheckRequest& request, const grade::Query& query,
                          const std::filesystem::path& file);

// Returns the answers that get a case file. Of graded cases they are the tally's. Of axes and counts, whose rows
// say only where an answer was wrong, each is asked for again:
// - of axes for ours in double one case of each axis on which a task is silently wrong or lost, at the first
//   such value; for a peer in a scalar the worst silent errors of three axes, and one query that it crashes
//   or hangs in. Hulls of more than a hundred vertices are left out;
// - of counts for ours the first case of each regime that was silently wrong or lost, and for a peer in a scalar
//   the first of all.
std::vector<grade::GradedAnswer> failing_answers(const CheckRequest& request, const Tally& tally);

// Writes the cases of these answers, each shrunk while it still fails in the same way, to
// failures/ALGORITHM-SCALAR-TASK.jsonl in the request's folder, one case per line. First it removes
// the case files of an earlier check.
std::vector<FailureCase> write_failures(const CheckRequest& request,
                                        const std::vector<grade::GradedAnswer>& failures);
// Write failures/ALGORITHM-SCALAR-TASK-variants.jsonl and failures/truth.jsonl; these cases are not
// shrunk. To be called after write_failures.
std::vector<VariantFailure> write_variant_failures(const CheckRequest& request, const Tally& tally);
std::vector<TruthFailure> write_truth_failures(const CheckRequest& request, const Tally& tally);

// Writes the first case of each count that has missed, false, inexact or failed ones, into failures/: all
// of ours, and one of a family for each other contestant. To be called after write_failures.
std::vector<FamilyFailure> write_family_failures(const CheckRequest& request, const Tally& tally);

}  // namespace touchstone::check
