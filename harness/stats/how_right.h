// The part of a summary that names who was wrong: libraries, ours, and what is approximate by design.
#pragma once

#include <span>
#include <string>

#include "harness/record/findings.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

// Returns the lines HOW RIGHT; empty if nothing was checked. `stopped`: the check did not come to its end.
std::string how_right(const Results& results, const Tables& tables,
                      std::span<const record::Departure> departures, bool stopped);

}  // namespace touchstone::stats
