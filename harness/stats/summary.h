// What a run says at its end: a summary on one screen, the tables, and published results beside ours.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/grade/margins.h"
#include "harness/record/findings.h"
#include "harness/stats/published.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

// Where a run was stopped, and the command that goes on with it.
struct Stop {
  std::string at;  // such as "the check of block 3 of 13"
  std::string go_on;
};

struct ReportSetting {
  Noise noise = Noise::left_out;
  double depth_error = grade::usual_depth_error;
  std::vector<std::string> own = {};  // algorithms that the user named: each has a line
  std::optional<Stop> stopped = {};
};

// Returns how fast ours are against libraries, for each scene that was asked everything and for each
// question; who was wrong, libraries first; what is not to be trusted; and where more stands. Nothing
// is said of what was not checked, and of who is faster where too few squares were left undisturbed.
std::string summary(const Results& results, const Tables& tables,
                    std::span<const record::Departure> departures,
                    const std::filesystem::path& folder, const ReportSetting& setting = {});

struct RunReport {
  std::string tables, published, summary;  // texts; `published` is empty if nothing was
};

// Writes tables.md into the folder, and published.csv and published.md where the campaign names
// published results and `published` is not null. Throws InputError if a file cannot be written.
RunReport write_report(const Results& results, std::span<const record::Departure> departures,
                       const Published* published, const ReportSetting& setting,
                       const std::filesystem::path& folder);

}  // namespace touchstone::stats
