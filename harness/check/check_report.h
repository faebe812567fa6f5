// What a check found, as tables: for the terminal, as a CSV file and as a page.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/check/broad/broad_check.h"
#include "harness/check/failures.h"
#include "harness/check/tally.h"

namespace touchstone::check {

struct CheckReport {
  const CheckRequest* request = nullptr;
  const Tally* tally = nullptr;
  std::vector<FailureCase> failures;  // of ours and of others
  std::vector<VariantFailure> variant_failures;
  std::vector<TruthFailure> truth_failures;
  std::vector<BroadCheck> broad;

  // What of ours is wrong beyond its documented margin, a line each; empty where nothing is.
  std::vector<std::string> ours_wrong() const;
};

// A line for each algorithm and scalar, then what was checked beside them.
std::string summary_text(const CheckReport& report, std::size_t page_width);

// summary.csv: a row for each algorithm, scalar and regime.
void write_summary(const CheckReport& report, const std::filesystem::path& file);

// The Markdown page of who is wrong where. `command` is what made it.
std::string page_text(const CheckReport& report, const std::string& command);

}  // namespace touchstone::check
