// The times of configurations on a scene, by the measuring loop: each configuration in warm
// processes of its own, each round on a window of frames of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/measure/measuring_loop.h"
#include "harness/trade/evaluation.h"

namespace touchstone::trade {

struct TimedPoint {
  // Seconds a frame: the baseline's median times the median of the paired ratios to it, and the
  // sign test's interval at 95 %; NaN where there is none.
  double seconds = Outcome::none, low = Outcome::none, high = Outcome::none;
  StageSeconds stages{};  // medians
  std::int64_t rounds = 0;
  process::ItemState state = process::ItemState::done;  // how its worker ended, if it failed
  std::string words;                                    // why

  bool ok() const { return state == process::ItemState::done; }
};

// A sample of a configuration, with the round that it is in.
struct PointSample {
  std::size_t point;
  bool control;         // the A/A control: a second registration of the baseline
  std::int64_t square;  // numbered through all sets
  const measure::Round& round;
  const measure::Sample& sample;
};

struct TimingPlan {
  int threads = 2;
  double seconds = 60;     // about, for all; every point gets one process in any case
  int processes = 3;       // of each point, one after the other
  double time_limit = 10;  // seconds for a frame; beyond, the point is lost
  std::uint64_t seed = 1;  // of the order
  std::size_t memory = std::size_t{4} << 30;
};

struct PointTimes {
  std::vector<TimedPoint> points;
  double control = Outcome::none;  // time of the A/A control over the baseline's: 1 if all is well
};

// `rough`: seconds a frame of each point, about; the first is the baseline. Points of like speed
// are timed together, with the baseline, its control and the same frames.
PointTimes time_points(const SceneFrames& frames, std::span<const TradePoint> points,
                       std::span<const double> rough, Task task, const TimingPlan& plan,
                       const std::function<void(const PointSample&)>& keep);

}  // namespace touchstone::trade
