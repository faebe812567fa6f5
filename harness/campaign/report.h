// The tables that a campaign prints, all from its rows and departures.
#pragma once

#include <cstddef>
#include <string>

#include "harness/record/findings.h"

namespace touchstone {

struct ReportStyle {
  std::size_t page_width = 120;
  bool noisy = false;  // rounds with flags of noise count too
};

// Broad phases by scene and count: milliseconds a frame, the median of the samples; a frame is
// update (or build, where every frame is built anew) and find_pairs.
std::string broad_table(const Findings& findings, const ReportStyle& style);

// Narrow phases by kind of pairs, one table a task: nanoseconds a query, the median of the samples.
std::string narrow_tables(const Findings& findings, const ReportStyle& style);

// How the measuring went: why it ended, and how many rounds were disturbed. Empty where there is no
// sample.
std::string measurement_notes(const Findings& findings, const ReportStyle& style);

// Who departed from whom, on what, by how much, and the file that shows it.
std::string departures(const Findings& findings);

}  // namespace touchstone
