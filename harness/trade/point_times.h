// The times of configurations on a scene: interleaved in shuffled rounds, each in warm processes of
// its own, each round on frames of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/measure/sampler.h"
#include "harness/trade/evaluation.h"

namespace touchstone {

struct TimedPoint {
  // Of a frame: the baseline's median times the median of the paired ratios to it, and the sign
  // test's interval at 95 %; NaN where there is none.
  double seconds = Outcome::none, low = Outcome::none, high = Outcome::none;
  StageSeconds stages{};  // medians
  std::int64_t rounds = 0;
  std::string status = "ok";  // else crashed, timed_out or threw, with its last words
  std::string words;
};

// One sample, as raw.csv has it: a row for each stage.
struct PointSample {
  std::size_t point = 0;
  bool twin = false;
  std::int64_t process = 0, square = 0, round = 0, position = 0;
  std::uint32_t frame = 0, frames = 0;
  SampleReply reply;
  std::string noise, status = "ok";
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
  double twin = Outcome::none;  // of the baseline's second registration to itself: 1 if all is well
};

// `rough`: seconds a frame of each point, about; the first is the baseline. Points of like speed
// are timed together, with the baseline, its twin and the same frames.
PointTimes time_points(const SceneFrames& frames, std::span<const TradePoint> points,
                       std::span<const double> rough, Task task, const TimingPlan& plan,
                       const std::function<void(const PointSample&)>& keep);

}  // namespace touchstone
