// Checks whether the ratios of a table, and published results, hold in measured ones.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/row.h"
#include "harness/stats/published.h"
#include "harness/stats/samples.h"
#include "harness/stats/statistics.h"

namespace touchstone::stats {

// A band is of one machine. Others have other caches, vectors and loads: on a second one a ratio was
// off its band by a factor of 1.2. No machine is expected to explain more than this one.
inline constexpr double machine_spread = 2;

// Pass: the ratio's interval lies within the stated band. Fail: it lies wholly outside the band
// that is wider by machine_spread on both sides. Differs: it lies wholly outside the band, but not
// that far. Faster: it lies wholly below, and an algorithm of ours is compared with a library.
// Undecided: none of these, or there is no interval, or no band, or the set is suspect here or there.
enum class Holds : std::uint8_t { pass, fail, differs, faster, undecided };
std::string_view to_string(Holds holds);
Holds holds(const MedianInterval& ratio, double band_low, double band_high);

struct CheckedCell {
  SetKey key;
  std::string label, baseline;
  bool canary = false;                             // true for the baseline against its twin
  double stated = 0, band_low = 0, band_high = 0;  // stated by the table
  MedianInterval ratio;                            // measured in the other results
  Holds state = Holds::undecided;
};

struct TableCheck {
  // Hashes, pair counts, contact counts and work counters that differ in any digit.
  std::vector<std::string> changed;
  // Cells that were not checked: an algorithm that is not built here, a scene that was left out.
  std::vector<std::string> left_out;
  std::vector<CheckedCell> cells;
};

// The stated bands are those of library_ratios.csv in the reference's folder, or of ratios.csv if
// it has no such file; raw.csv and machine.csv are beside it. Throws InputError with file and line.
TableCheck check_tables(const std::filesystem::path& reference, const Results& here, Noise noise);

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
