// What the checks of a block share: the exact answers, the files that reproduce departures, and the
// findings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/campaign/blocks.h"
#include "harness/grade/answer_check.h"
#include "harness/measure/block_input.h"

namespace touchstone::campaign {

// Returns "BROAD|TASK|KIND" for a set of narrow phases; the set of the broad phases is "".
std::string set_key(const measure::NarrowSet& set);
std::string set_key(const record::RawRow& row);

// The results of one algorithm on one set, at one thread.
struct Checked {
  bool out = false;                 // true if it crashed, was too slow or wrong: it is not timed
  std::vector<std::int64_t> pairs;  // one for each frame; 0 if there is no row
  std::vector<std::uint64_t> hash;  // hash of the pairs, or of the outcomes
  std::vector<double> seconds;      // seconds of all phases
  std::vector<std::int64_t> disagreements;  // counts of narrow phases
  bool gave_up = false;                     // true if some answer is an honest failure

  double greatest_seconds() const;
};

// It has the findings of a block's check pass, from its rows. A run that is resumed reads the same rows.
class CheckTable {
 public:
  // Takes the rows of this block's check pass.
  CheckTable(std::span<const record::RawRow> rows, std::int64_t block, std::size_t frames);
  // Returns null if the algorithm never got such pairs. A broad phase that found the true pairs has
  // no entry of its own: its pairs are checked as the true ones.
  const Checked* find(const std::string& label, const measure::NarrowSet* set) const;

 private:
  std::map<std::pair<std::string, std::string>, Checked> table_;
};

class ExactAnswers {
 public:
  // The input outlives it.
  explicit ExactAnswers(const measure::BlockInput& input);
  // Equal for sets whose pairs have the same exact answers. Those of convex bodies serve every task.
  static std::string key(const measure::NarrowSet& set);
  std::vector<grade::ReferenceOutcome> solve(const measure::NarrowSet& set, std::size_t frame);

 private:
  const measure::BlockInput* input_;
  Executor executor_{1};
  grade::Reference convex_;
  std::optional<grade::ConcaveReference> concave_;
};

// Has `write` write reproductions/block-N/NAME.ENDING in the results folder of the run, where NAME is
// `text` made safe and unique, and sets the departure's reproduction. A file that cannot be written is
// a note in the departure. Does nothing without a results folder.
void write_reproduction(const RunContext& context, std::string_view text, std::string_view ending,
                        const std::function<void(const std::filesystem::path&)>& write,
                        record::Departure& departure);

}  // namespace touchstone::campaign
