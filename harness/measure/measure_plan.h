// The plan of a measurement: contestants, the sets and groups in which they meet, squares, windows
// of frames, processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/measure/latin_square.h"
#include "harness/measure/worker.h"

namespace touchstone::measure {

// Anything that can be timed. Of two contestants of a set that differ by nothing but `control`, the
// one with it is the A/A control: the difference of their times is the error of the measurement.
struct MeasuredContestant {
  std::string label;
  bool control = false;
  Worker::Make make;
};

// Contestants that are given the same input and the same requests.
struct MeasuredSet {
  std::uint32_t number = 0;                      // of the input, in requests
  std::vector<std::size_t> members;              // contestants: the baseline first
  std::vector<std::vector<std::size_t>> groups;  // of members; those of a group share each round
  std::size_t most_rounds = SIZE_MAX;            // of a square; it has one for each of its group
  std::size_t frames = 1;                        // of the input
  std::vector<std::size_t> starts = {0};         // frames at which a window may begin, rising
  std::uint32_t window = 1;                      // frames of a sample
  bool skips_first = false;                      // no window goes over frame 0
  std::size_t warm_up_windows = 0;               // that a worker plays untimed before a lap

  // The rounds of a group's square that are taken.
  std::size_t rounds(std::size_t group) const;
  // Squares are numbered through all groups of a set: `lap` counts those of one group.
  std::int64_t square(int lap, std::size_t group) const {
    return static_cast<std::int64_t>(static_cast<std::size_t>(lap) * groups.size() + group);
  }
  // The request of a round's samples: each window begins where the one of the round before ended.
  SampleRequest request(int lap, std::size_t group, std::size_t round) const;
  // The request of an untimed window before a lap's first round.
  SampleRequest warm_up_request(int lap, std::size_t group, std::size_t warm_up_window) const;

 private:
  SampleRequest window_at(std::size_t place) const;
};

// A process of a contestant lives through the laps [first, end).
struct ProcessLaps {
  int process, first, end;
};
// The intervals are looked at when a period is over, and at no other time: a look after every
// square would find a narrow interval by chance.
using Period = std::vector<ProcessLaps>;
inline constexpr int first_look = 6;  // squares; with fewer there is no interval of 95 %
// Looks after 6, 12, 24 and 48 squares of a group, by so many processes each; or one period of as
// many squares as are asked for.
std::vector<Period> periods(std::optional<int> squares, int processes);

struct MeasurePlan {
  std::vector<MeasuredContestant> contestants;
  std::vector<MeasuredSet> sets;
  std::vector<Period> periods;
  // A worker takes the samples of all sets that its contestant is in; else each set has workers of
  // its own.
  bool shares_workers = true;
  std::size_t memory = std::size_t{4} << 30;  // bytes that a worker may add
  double setup_seconds = 60;                  // for the setup of a worker
  std::uint64_t seed = 1;                     // of the orders, and of the workers' memory layouts
  std::uint64_t number = 0;                   // tells plans of the same seed apart
};

// The order of a square's rounds.
LatinSquare square_order(const MeasurePlan& plan, std::size_t set, std::int64_t square,
                         std::size_t size);

}  // namespace touchstone::measure
