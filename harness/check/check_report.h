// The findings of a check as tables: for the terminal, as a CSV file and as a page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/check/broad_check.h"
#include "harness/check/failures.h"
#include "harness/check/tally.h"

namespace touchstone::check {

struct CheckReport {
  const CheckRequest* request = nullptr;
  Tally tally;
  std::int64_t jobs = 0;              // that are done
  std::vector<FailureCase> failures;  // failures of ours and of others
  std::vector<VariantFailure> variant_failures;
  std::vector<TruthFailure> truth_failures;
  std::vector<FamilyFailure> family_failures;
  std::vector<BoxScene> scenes;
  std::vector<BroadCheck> broad;  // refers to the scenes
  bool interrupted = false;       // rows are kept, and nothing is made of them

  // Lists the faults of ours, one line each: of cases those beyond the documented margins, of axes and counts
  // verdicts that are silently wrong, and queries that crashed or hung. Empty if there are none.
  std::vector<std::string> ours_wrong() const;
};

// Returns the text for the terminal. Of cases it has a line for each algorithm and scalar, the checks of
// certificates, boxes and broad phases, and the tables of families; of axes the first failures along each;
// of counts the sums over all regimes.
std::string summary_text(const CheckReport& report, std::size_t page_width);

// Writes summary.csv: a row for each algorithm, scalar and regime.
void write_summary(const CheckReport& report, const std::filesystem::path& file);

// Returns the Markdown page of errors, or of the first failures along axes. `command` is the command that
// made it. `pictures` is the path of the maps of axes from the page's folder; if it is empty, the page has
// no maps.
std::string page_text(const CheckReport& report, const std::string& command,
                      const std::string& pictures = "");

// The text and the page of axes.
std::string axes_text(const CheckReport& report, std::size_t page_width);
std::string axes_page(const CheckReport& report, const std::string& command,
                      const std::string& pictures);

}  // namespace touchstone::check
