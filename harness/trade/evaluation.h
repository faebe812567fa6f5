// The errors of configurations on a scene: each plays the frames whose truth is known.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/trade/errors.h"

namespace touchstone {

// What is compared on a scene. All answer the same question.
struct TradePoint {
  Configuration configuration;
  std::shared_ptr<const StandIns> stand_ins;
};

struct Evaluation {
  PointErrors errors;
  PipelineCounters counters;
  StageSeconds rough{};  // a frame, read once: for planning only
  // "ok"; else crashed, timed_out or threw, and the rest means nothing.
  std::string status = "ok";
  std::string words;
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

}  // namespace touchstone
