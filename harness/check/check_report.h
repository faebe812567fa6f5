// The findings of a check as tables: for the terminal, as a CSV file and as a page.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/check/broad/broad_check.h"
#include "harness/check/failures.h"
#include "harness/check/families/family_failures.h"
#include "harness/check/tally.h"

namespace touchstone::check {

struct CheckReport {
  const CheckRequest* request = nullptr;
  const Tally* tally = nullptr;
  std::vector<FailureCase> failures;  // failures of ours and of others
  std::vector<VariantFailure> variant_failures;
  std::vector<TruthFailure> truth_failures;
  std::vector<FamilyFailure> family_failures;
  std::vector<BroadCheck> broad;

  // Lists the faults of ours beyond their documented margins, one line each; empty if there are
  // none.
  std::vector<std::string> ours_wrong() const;
};

// Returns a line for each algorithm and scalar, then the checks of certificates, boxes and broad
// phases, and the tables of families.
std::string summary_text(const CheckReport& report, std::size_t page_width);

// Writes summary.csv: a row for each algorithm, scalar and regime.
void write_summary(const CheckReport& report, const std::filesystem::path& file);

// Returns the Markdown page of errors. `command` is the command that made it.
std::string page_text(const CheckReport& report, const std::string& command);

}  // namespace touchstone::check
