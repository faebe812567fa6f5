// The errors of configurations on a scene: each one plays the frames whose exact answers are known.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/process/isolate.h"
#include "harness/trade/errors.h"

namespace touchstone::trade {

// A configuration that is compared on a scene, with what stands for the bodies there.
struct TradePoint {
  Configuration configuration;
  std::shared_ptr<const StandIns> stand_ins;
};

struct Evaluation {
  PointErrors errors;
  PipelineCounters counters;
  StageSeconds rough{};  // a frame, read once: for planning only
  process::ItemState state =
      process::ItemState::done;  // how it ended; if it failed, the rest means nothing
  std::string words;             // why it failed

  bool ok() const { return state == process::ItemState::done; }
  double rough_seconds() const;
};

struct EvaluationLimits {
  double seconds = 60;  // for one configuration
  std::size_t memory = std::size_t{4} << 30;
};

// One after the other in a child process, so that what crashes costs itself alone.
std::vector<Evaluation> evaluate(const SceneFrames& frames, std::span<const TradePoint> points,
                                 std::span<const FrameTruth> truth, Task task,
                                 const EvaluationLimits& limits = {});

}  // namespace touchstone::trade
