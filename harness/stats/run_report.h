// What stands beside the rows of a run: tables, published results, and a summary.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "harness/record/findings.h"
#include "harness/stats/published.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

struct ReportSetting {
  Noise noise = Noise::left_out;
  double depth_error = usual_depth_error;
};

struct RunReport {
  std::string tables, published, summary;  // texts; `published` is empty if nothing was
};

// Writes tables.md into the folder, and published.csv and published.md where the campaign names
// published results and `published` is not null. Throws InputError if a file cannot be written.
RunReport write_report(const Results& results, std::span<const record::Departure> departures,
                       const Published* published, const ReportSetting& setting,
                       const std::filesystem::path& folder);

}  // namespace touchstone::stats
