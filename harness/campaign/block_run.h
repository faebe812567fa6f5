// Takes the samples of one block: processes, squares, rounds, and when to stop.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/campaign/schedule.h"
#include "harness/campaign/set_times.h"
#include "harness/measure/worker.h"

namespace touchstone {

class BlockRun {
 public:
  // All but the schedule outlive it. The findings may hold rows of this block's samples, whole
  // rounds of them: it goes on behind them.
  BlockRun(const RunContext& context, const BlockInput& input, std::span<const NarrowSet> narrow,
           const CheckTable& checks, Schedule schedule);

  // Calls `commit` whenever a round has been added to the findings; ends early when that returns
  // false.
  void run(const std::function<bool()>& commit);

 private:
  struct SetState {
    SetTimes times;
    double spent = 0;  // seconds, over its rounds
    bool stopped = false;
    std::set<std::pair<std::int64_t, std::int64_t>> done;  // square, round
  };
  struct Place {  // a round
    std::size_t set;
    int process, lap;
    std::size_t group, round;
    bool ends_lap, ends_stage, ends_all;
  };

  void take_over(const RawRow& row);
  bool run_process(const ProcessSpan& span, bool ends_stage, bool ends_all);
  bool any_left(const std::vector<std::size_t>& contestants) const;
  bool is_open(std::size_t set, const ProcessSpan& span) const;
  // The worker after its untimed pass, or null where it failed that.
  std::unique_ptr<Worker> start(std::size_t contestant, int process,
                                const std::vector<std::size_t>& sets);
  void verify(Worker& worker, std::size_t contestant, int process,
              const std::vector<std::size_t>& sets);
  void run_round(const Place& place);
  struct Taken {
    std::vector<RawRow> rows;  // of one sample; a failure is one row
    std::optional<Departure> departure;
  };
  Taken sample(const Place& place, std::size_t contestant, std::uint32_t frame);
  std::string reason_to_stop(const Place& place) const;
  bool canary_sings(const Place& place) const;

  RawRow row_of(std::size_t contestant, std::size_t set, std::size_t frame) const;
  Worker::Make maker(std::size_t contestant) const;
  double deadline(std::size_t contestant, std::size_t set, std::size_t frames) const;
  bool matches(const SampleReply& reply, std::size_t contestant, std::size_t set,
               const SampleRequest& request) const;
  // Marks it as out of the block.
  Taken leave(RawRow row, std::size_t contestant, RowStatus status, const std::string& what,
              const std::string& words, bool known);
  Taken lose(RawRow row, std::size_t contestant, const IsolationFailure& failure);
  void add(Taken taken);

  const RunContext* context_;
  const BlockInput* input_;
  std::span<const NarrowSet> narrow_;
  const CheckTable* checks_;
  Schedule schedule_;
  std::vector<SetState> states_;
  std::vector<char> out_;                         // of each contestant
  std::vector<std::unique_ptr<Worker>> workers_;  // of each contestant; null: none at the moment
  std::function<bool()> commit_;
};

}  // namespace touchstone
