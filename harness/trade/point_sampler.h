// Samples of a whole configuration, for the measuring loop.
#pragma once

#include <memory>

#include "harness/measure/sampler.h"
#include "harness/trade/evaluation.h"

namespace touchstone::trade {

// Frames are played in order and again and again. They begin at frame 0, which belongs to no
// sample; if the scene has no other frame, each of its samples begins anew. The durations are the
// stages of the pipeline.
class PointSampler final : public measure::Sampler {
 public:
  // The frames outlive it.
  PointSampler(const SceneFrames& frames, const TradePoint& point, Task task, int threads,
               ExecutorKind executor);

  measure::SampleReply sample(const measure::SampleRequest& request) override;

 private:
  void play_up_to(std::size_t frame);

  const SceneFrames* frames_;
  TradePoint point_;
  Executor executor_;
  FramePipeline pipeline_;
  bool started_ = false;
};

}  // namespace touchstone::trade
