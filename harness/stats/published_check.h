// Published results beside those measured here.
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

// A count of iterations holds where the mean here is within one published deviation of the
// published mean; `faster` where the whole interval of the ratio is; `suffices` where no answer is
// wrong, and `here` says how many were. A claim that no set is about gives one row that says so,
// undecided.
std::vector<PublishedRow> check_published(const Published& published, const Results& results,
                                          Noise noise);

// As Markdown, with the source; readable in a terminal as well.
std::string published_text(const Published& published, const std::vector<PublishedRow>& rows);

// Writes published.md and published.csv into the folder.
void write_published(const Published& published, const std::vector<PublishedRow>& rows,
                     const std::filesystem::path& folder);

}  // namespace touchstone::stats
