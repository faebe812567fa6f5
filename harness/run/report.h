// The tables that a campaign prints.
#pragma once

#include <string>

#include "harness/run/findings.h"

namespace touchstone {

// Broad phases by scene and count: milliseconds a frame, the median over the frames; a frame is
// update (or build, where every frame is built anew) and find_pairs.
std::string broad_table(const Findings& findings, std::size_t page_width);

// Narrow phases by kind of pairs, one table a task: nanoseconds a query, the median
// over the frames, weighted by their queries.
std::string narrow_tables(const Findings& findings, std::size_t page_width);

// Who departed from whom, on what, by how much, and the file that shows it.
std::string departures(const Findings& findings);

}  // namespace touchstone
