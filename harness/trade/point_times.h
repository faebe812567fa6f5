// The times of configurations on a scene, by the measuring loop.
// Each configuration runs in warm processes of its own, and each round plays another window of
// frames.
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
  // sign test's interval at 95 %; NaN if there is none.
  double seconds = Outcome::none, low = Outcome::none, high = Outcome::none;
  StageSeconds stages{};  // medians
  std::int64_t rounds = 0;
  process::ItemState state = process::ItemState::done;  // the end of its worker, if that failed
  std::string words;                                    // the reason of a failure

  bool ok() const { return state == process::ItemState::done; }
};

// A sample of a configuration, with the round that it is in.
struct PointSample {
  std::size_t point;
  bool control;         // true for the A/A control: a second registration of the baseline
  std::int64_t square;  // its number among the squares of all sets
  const measure::Round& round;
  const measure::Sample& sample;
};

struct TimingPlan {
  int threads = 2;
  ExecutorKind executor = usual_executor;
  double seconds = 60;     // approximate total; every point gets one process in any case
  int processes = 3;       // the number for each point, one after the other
  double time_limit = 10;  // seconds for a frame; a point that takes longer is lost
  std::uint64_t seed = 1;  // the seed of the order
  std::size_t memory = std::size_t{4} << 30;
};

struct PointTimes {
  std::vector<TimedPoint> points;
  double control = Outcome::none;  // the time of the A/A control over the baseline's, ideally 1
};

// `rough` is the approximate time of each point, in seconds a frame; the first is the baseline.
// Points of similar speed are timed together, with the baseline, its control and the same frames.
PointTimes time_points(const SceneFrames& frames, std::span<const TradePoint> points,
                       std::span<const double> rough, Task task, const TimingPlan& plan,
                       const std::function<void(const PointSample&)>& keep);

}  // namespace touchstone::trade
