// Published results beside measured ones.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/row.h"
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

// published.csv
template <record::row_of<PublishedRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("scene", row.key.scene, "The scene's name.");
  visit("bodies", row.key.bodies, "Number of bodies.");
  visit("task", row.key.task, "Task of the narrow phases; empty for broad phases.");
  visit("pair_kind", row.key.pair_kind, "The kinds of the two shapes; empty for broad phases.");
  visit("threads", row.key.threads, "Width of the executor.");
  visit("claim", row.claim, "What was published.");
  visit("published", row.published, "The published value.");
  visit("here", row.here, "The measured value.");
  visit("holds", row.state, "Whether the claim holds here.");
}

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
