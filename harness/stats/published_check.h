// Published results beside measured ones.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/stats/published.h"
#include "harness/stats/samples.h"
#include "harness/stats/table_check.h"

namespace touchstone::stats {

// One claim in one set.
struct PublishedRow {
  SetKey key;
  std::string claim;            // "iterations of gjk double"
  std::string published, here;  // "16 +- 5", "15.3 +- 4.1"
  Holds state = Holds::undecided;
};

// Checks each claim. A count of iterations holds if the measured mean is within one published
// deviation of the published mean; `faster` holds if the whole interval of the ratio supports it;
// `suffices` holds if no answer is wrong, and `here` has the number of wrong ones. A claim that
// concerns no set gives one row that says so, undecided.
std::vector<PublishedRow> check_published(const Published& published, const Results& results,
                                          Noise noise);

// Returns Markdown with the source, which is readable in a terminal as well.
std::string published_text(const Published& published, const std::vector<PublishedRow>& rows);

// Writes published.md and published.csv into the folder.
void write_published(const Published& published, const std::vector<PublishedRow>& rows,
                     const std::filesystem::path& folder);

}  // namespace touchstone::stats
