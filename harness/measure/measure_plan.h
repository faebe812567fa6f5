// The plan of a measurement: contestants, sets and groups, Latin squares, windows, processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/random.h"
#include "harness/measure/worker.h"

namespace touchstone::measure {

// Latin squares: the order in which contestants run.

// The entry of round r and position p is one of `size` contestants. Each occurs once in every round
// and once in every position, so that neither the first position nor a drift over the rounds
// favours one. It is a cyclic square with its rounds, positions and contestants shuffled (Fisher
// and Yates 1938).
using LatinSquare = std::vector<std::vector<std::size_t>>;
LatinSquare latin_square(std::size_t size, base::Random& random);

// The plan of a measurement: contestants, sets and groups, squares, windows, processes.

// Anything that can be timed. If two contestants of a set differ only by `control`, the one with it
// is the A/A control: the difference of their times is the error of the measurement.
struct MeasuredContestant {
  std::string label;
  bool control = false;
  Worker::Make make;
};

// Contestants that get the same input and the same requests.
struct MeasuredSet {
  std::uint32_t number = 0;          // the number of the input, in requests
  std::vector<std::size_t> members;  // contestants: the baseline first
  // groups of members; the members of a group share each round
  std::vector<std::vector<std::size_t>> groups;
  // The most rounds of a square, which has one for each member of its group.
  std::size_t most_rounds = SIZE_MAX;
  std::size_t frames = 1;                 // the length of the input
  std::vector<std::size_t> starts = {0};  // frames at which a window may begin, rising
  std::uint32_t window = 1;               // frames of a sample
  bool skips_first = false;               // true if no window goes over frame 0
  std::size_t warm_up_windows = 0;        // the number that a worker plays untimed before a lap

  // Returns the number of rounds of a group's square that run.
  std::size_t rounds(std::size_t group) const;
  // Squares are numbered through all groups of a set; `lap` counts those of one group.
  std::int64_t square(int lap, std::size_t group) const {
    return static_cast<std::int64_t>(static_cast<std::size_t>(lap) * groups.size() + group);
  }
  // The request of a round's samples: each window begins where that of the round before ended.
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
// Returns looks after 6, 12, 24 and 48 squares of a group, each by so many processes; or, if
// `squares` is given, one period of as many squares.
std::vector<Period> periods(std::optional<int> squares, int processes);

struct MeasurePlan {
  std::vector<MeasuredContestant> contestants;
  std::vector<MeasuredSet> sets;
  std::vector<Period> periods;
  // If true, a worker takes the samples of all sets that its contestant is in; else each set has
  // workers of its own.
  bool shares_workers = true;
  std::size_t memory = std::size_t{4} << 30;  // bytes that a worker may add
  double setup_seconds = 60;                  // limit for the setup of a worker
  std::uint64_t seed = 1;    // the seed of the orders and of the workers' memory layouts
  std::uint64_t number = 0;  // distinguishes plans of the same seed
};

// The order of a square's rounds.
LatinSquare square_order(const MeasurePlan& plan, std::size_t set, std::int64_t square,
                         std::size_t size);

}  // namespace touchstone::measure
