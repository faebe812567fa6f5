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
  StageSeconds rough{};  // seconds a frame, from one reading: only for planning
  process::ItemState state =
      process::ItemState::done;  // if it is not `done`, the other members mean nothing
  std::string words;             // the reason of a failure

  bool ok() const { return state == process::ItemState::done; }
  double rough_seconds() const;
};

struct EvaluationLimits {
  double seconds = 60;  // the limit for one configuration
  std::size_t memory = std::size_t{4} << 30;
};

// Evaluates one after the other in a child process, so that a crash costs only its own
// configuration.
std::vector<Evaluation> evaluate(const SceneFrames& frames, std::span<const TradePoint> points,
                                 std::span<const FrameTruth> truth, Task task,
                                 const EvaluationLimits& limits = {});

}  // namespace touchstone::trade
