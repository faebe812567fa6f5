// Checks whether the ratios of a table hold in other results too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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

}  // namespace touchstone::stats
