// The one loop that measures: workers interleaved in shuffled Latin squares.
// Contestants run in worker processes of their own, until the plan is done or the job stops a set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/measure/measure_plan.h"
#include "harness/measure/worker.h"

namespace touchstone::measure {

// The reason why a set has no further rounds.
enum class Stop : std::uint8_t {
  none,
  crashed,  // no contestant is left
  rounds,   // the plan is done
  width,    // the intervals are narrow enough
  budget,   // the time is spent
};
std::string_view to_string(Stop stop);  // empty for `none`

// The end of a contestant, which takes no further part in the plan.
struct Loss {
  bool wrong = false;                 // true if its answer was wrong, and its worker had not failed
  process::IsolationFailure failure;  // the failure of its worker, unless the answer was wrong
};

struct Sample {
  std::size_t contestant = 0;
  std::int64_t position = 0;  // the position in its round
  SampleReply reply;
  std::optional<Loss> loss;  // set if there is no reply
};

// A round: every remaining contestant of a group takes one sample of the same window.
struct Round {
  std::size_t set = 0, group = 0;
  int process = 0, lap = 0;
  std::int64_t square = 0, round = 0;
  SampleRequest request;
  std::vector<Sample> samples;  // the samples by position; never empty
  std::string noise;            // flags of noise.h; empty if the machine was quiet
  double spent = 0;             // seconds of all rounds of the set so far
  bool ends_lap = false;     // true if it is the last round of this lap for all groups of the set
  bool ends_period = false;  // true if the intervals may be looked at
  Stop stop = Stop::none;
};

// The user of the loop: it defines what is measured and receives the results.
class MeasuringJob {
 public:
  virtual ~MeasuringJob() = default;

  // Requests that a new worker answers untimed before its samples in these sets.
  struct Untimed {
    std::size_t set;
    SampleRequest request;
  };
  virtual std::vector<Untimed> warm_up(std::size_t contestant, std::span<const std::size_t> sets,
                                       const ProcessLaps& process) = 0;
  // Returns the time limit of a sample of so many frames, seconds.
  virtual double deadline(std::size_t contestant, std::size_t set, std::uint32_t frames) const = 0;
  // Returns true if an answer equals the checked one. It runs outside the clock.
  virtual bool is_right(std::size_t contestant, std::size_t set, const SampleRequest& request,
                        const SampleReply& reply) const = 0;
  // Returns true if a set may begin a process, which costs time.
  virtual bool has_time(std::size_t set, const ProcessLaps& process) const = 0;

  // Takes the loss of a contestant before its first sample of a process, in this frame of a set.
  virtual void lose(std::size_t contestant, std::size_t set, int process, std::uint32_t frame,
                    const Loss& loss) = 0;
  // Takes the samples of a round; if `stop` is `none`, it may set it.
  virtual void take(Round& round) = 0;
  // The loop calls this after each start of a worker and after each round, and ends if it returns
  // false.
  virtual bool goes_on() = 0;
};

// The progress of a set, from which an interrupted run goes on.
struct SetProgress {
  std::set<std::pair<std::int64_t, std::int64_t>> done;  // square, round
  double spent = 0;                                      // seconds over its rounds
  bool stopped = false;
};

class MeasuringLoop {
 public:
  // The plan and the job outlive it. `progress` has one entry for each set; `lost` has a 1 for each
  // contestant that takes no part. Either may be empty.
  MeasuringLoop(const MeasurePlan& plan, MeasuringJob& job, std::vector<SetProgress> progress = {},
                std::vector<char> lost = {});

  void run();

 private:
  // One for each contestant; null if it has none.
  using Workers = std::vector<std::unique_ptr<Worker>>;
  struct Place {  // the place of a round in the loop
    std::size_t set;
    const ProcessLaps& process;
    bool is_last_of_period, is_last;  // properties of the process
    int lap;
    std::size_t group, round;
  };

  std::vector<std::vector<std::size_t>> shares() const;
  std::vector<std::size_t> open_sets(std::span<const std::size_t> sets,
                                     const ProcessLaps& process) const;
  bool is_open(std::size_t set, const ProcessLaps& process) const;
  bool is_done(std::size_t set, int lap, std::size_t group, std::size_t round) const;
  bool any_left(std::span<const std::size_t> contestants) const;
  bool start_workers(std::span<const std::size_t> sets, const ProcessLaps& process,
                     Workers& workers);
  std::unique_ptr<Worker> start_worker(std::size_t contestant, std::span<const std::size_t> sets,
                                       const ProcessLaps& process);
  void run_round(const Place& place, Workers& workers);
  Sample sample(std::size_t contestant, std::size_t set, const SampleRequest& request,
                std::unique_ptr<Worker>& worker);
  void judge(const Place& place, Round& round);

  const MeasurePlan& plan_;
  MeasuringJob& job_;
  std::vector<SetProgress> progress_;
  std::vector<char> lost_;
};

}  // namespace touchstone::measure
