// The samples of one block: a job for the measuring loop, whose rounds become rows of the findings.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/campaign/schedule.h"
#include "harness/campaign/set_times.h"
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

class BlockRun final : private measure::MeasuringJob {
 public:
  // All arguments but the schedule outlive it. The findings may hold whole rounds of this block's
  // samples: it continues behind them.
  BlockRun(const RunContext& context, const measure::BlockInput& input,
           std::span<const measure::NarrowSet> narrow, const CheckTable& checks, Schedule schedule);
  BlockRun(const BlockRun&) = delete;  // its members hold references to each other
  BlockRun& operator=(const BlockRun&) = delete;

  // Calls `commit` after each round that is added to the findings; ends early if `commit` returns
  // false.
  void run(const std::function<bool()>& commit);

 private:
  std::vector<Untimed> warm_up(std::size_t contestant, std::span<const std::size_t> sets,
                               const measure::ProcessLaps& process) override;
  double deadline(std::size_t contestant, std::size_t set, std::uint32_t frames) const override;
  bool is_right(std::size_t contestant, std::size_t set, const measure::SampleRequest& request,
                const measure::SampleReply& reply) const override;
  bool has_time(std::size_t, const measure::ProcessLaps&) const override { return true; }
  void lose(std::size_t contestant, std::size_t set, int process, std::uint32_t frame,
            const measure::Loss& loss) override;
  void take(measure::Round& round) override;
  bool goes_on() override { return commit_(); }

  void take_over(const record::RawRow& row);
  measure::MeasurePlan plan() const;
  const Checked& checked(std::size_t contestant, std::size_t set) const;
  measure::Stop reason_to_stop(const measure::Round& round) const;
  bool all_narrow(std::size_t set) const;

  const RunContext& context_;
  const measure::BlockInput& input_;
  std::span<const measure::NarrowSet> narrow_;
  const CheckTable& checks_;
  Schedule schedule_;
  BlockRows rows_;
  std::vector<SetTimes> times_;                 // one for each set
  std::vector<measure::SetProgress> progress_;  // one for each set, as at the start
  std::vector<char> lost_;                      // one for each candidate, as at the start
  std::function<bool()> commit_;
};

}  // namespace touchstone::campaign
