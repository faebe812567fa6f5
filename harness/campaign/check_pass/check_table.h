// What the check pass of a block found, as its rows tell it: what a run that goes on after a stop
// needs is read from the same rows.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/campaign/run_context.h"
#include "harness/measure/block_input.h"

namespace touchstone {

// "BROAD|TASK|KIND": a set of narrow phases; that of the broad phases is "".
std::string set_key(const NarrowSet& set);
std::string set_key(const RawRow& row);

// One algorithm on one set, at one thread.
struct Checked {
  bool out = false;                         // crashed, too slow or wrong: it is not timed
  std::vector<std::int64_t> pairs;          // of each frame; 0 where there is no row
  std::vector<std::uint64_t> hash;          // of the pairs, or of the outcomes
  std::vector<double> seconds;              // all phases
  std::vector<std::int64_t> disagreements;  // of narrow phases
  bool gave_up = false;                     // some answer is an honest failure

  double greatest_seconds() const;
};

class CheckTable {
 public:
  // Of the rows of this block's check pass.
  CheckTable(std::span<const RawRow> rows, std::int64_t block, std::size_t frames);
  // Null: never given such pairs. The pairs of a broad phase that found the true ones are checked
  // as these.
  const Checked* find(const std::string& label, const NarrowSet* set) const;

 private:
  std::map<std::pair<std::string, std::string>, Checked> table_;
};

}  // namespace touchstone
