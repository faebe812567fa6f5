// The samples of one block: a job for the measuring loop, whose rounds become rows of the findings.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "harness/campaign/block_rows.h"
#include "harness/campaign/schedule.h"
#include "harness/campaign/set_times.h"
#include "harness/measure/measuring_loop.h"

namespace touchstone {

class BlockRun final : private MeasuringJob {
 public:
  // All but the schedule outlive it. The findings may hold rows of this block's samples, whole
  // rounds of them: it goes on behind them.
  BlockRun(const RunContext& context, const BlockInput& input, std::span<const NarrowSet> narrow,
           const CheckTable& checks, Schedule schedule);
  BlockRun(const BlockRun&) = delete;  // its members know each other's places
  BlockRun& operator=(const BlockRun&) = delete;

  // Calls `commit` whenever a round has been added to the findings; ends early when that returns
  // false.
  void run(const std::function<bool()>& commit);

 private:
  std::vector<Untimed> warm_up(std::size_t contestant, std::span<const std::size_t> sets,
                               const ProcessLaps& process) override;
  double deadline(std::size_t contestant, std::size_t set, std::uint32_t frames) const override;
  bool is_right(std::size_t contestant, std::size_t set, const SampleRequest& request,
                const SampleReply& reply) const override;
  bool has_time(std::size_t, const ProcessLaps&) const override { return true; }
  void lose(std::size_t contestant, std::size_t set, int process, std::uint32_t frame,
            const Loss& loss) override;
  void take(Round& round) override;
  bool goes_on() override { return commit_(); }

  void take_over(const RawRow& row);
  MeasurePlan plan() const;
  const Checked& checked(std::size_t contestant, std::size_t set) const;
  Stop reason_to_stop(const Round& round) const;
  bool all_narrow(std::size_t set) const;
  bool control_failed(std::size_t set) const;

  const RunContext& context_;
  const BlockInput& input_;
  std::span<const NarrowSet> narrow_;
  const CheckTable& checks_;
  Schedule schedule_;
  BlockRows rows_;
  std::vector<SetTimes> times_;        // of each set
  std::vector<SetProgress> progress_;  // of each set, when it begins
  std::vector<char> lost_;             // of each candidate, when it begins
  std::function<bool()> commit_;
};

}  // namespace touchstone
