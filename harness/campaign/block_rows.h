// The rows and departures of a block's samples.
#pragma once

#include <string>
#include <vector>

#include "harness/campaign/schedule.h"
#include "harness/measure/measuring_loop.h"

namespace touchstone {

class BlockRows {
 public:
  // Both outlive it.
  BlockRows(const RunContext& context, const Schedule& schedule)
      : context_(context), schedule_(schedule) {}

  // A row of a candidate in a set, with what the block decides.
  RawRow empty(std::size_t candidate, std::size_t set, std::size_t frame) const;
  // A row of a candidate with the place of a sample.
  RawRow of_sample(const Round& round, const Sample& sample) const;
  // A row for each duration of the reply; the last one has its counters. `gave_up`: the check
  // found honest failures among the candidate's answers.
  std::vector<RawRow> of_reply(const Round& round, const Sample& sample, bool gave_up) const;
  // Writes into the row how the candidate was lost. `wrong` says what a wrong answer is.
  Departure mark_lost(RawRow& row, std::size_t candidate, const Loss& loss,
                      const std::string& wrong) const;

 private:
  const RunContext& context_;
  const Schedule& schedule_;
};

}  // namespace touchstone
