// The rows and departures of a block's samples.
#pragma once

#include <string>
#include <vector>

#include "harness/campaign/schedule.h"
#include "harness/measure/measuring_loop.h"

namespace touchstone::campaign {

class BlockRows {
 public:
  // The context and the schedule must outlive this object.
  BlockRows(const RunContext& context, const Schedule& schedule)
      : context_(context), schedule_(schedule) {}

  // Returns a row of a candidate in a set, with the columns that the block decides.
  record::RawRow empty(std::size_t candidate, std::size_t set, std::size_t frame) const;
  // Returns a row of a candidate with the place of a sample.
  record::RawRow of_sample(const measure::Round& round, const measure::Sample& sample) const;
  // Returns a row for each duration of the reply; the last one has its counters. `gave_up`: the
  // check found honest failures among the candidate's answers.
  std::vector<record::RawRow> of_reply(const measure::Round& round, const measure::Sample& sample,
                                       bool gave_up) const;
  // Writes into the row how the candidate was lost. `wrong` describes a wrong answer.
  record::Departure mark_lost(record::RawRow& row, std::size_t candidate, const measure::Loss& loss,
                              const std::string& wrong) const;

 private:
  const RunContext& context_;
  const Schedule& schedule_;
};

}  // namespace touchstone::campaign
