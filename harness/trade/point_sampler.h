// A configuration in a worker process: what it does when it is asked for a sample.
#pragma once

#include <memory>

#include "harness/measure/sampler.h"
#include "harness/trade/evaluation.h"

namespace touchstone {

// Frames are played in order and again and again; frame 0 is where they begin, and belongs to no
// sample, unless the scene has no other: then each of its samples begins anew. `prepare` of the
// reply is boxes and update, `query` the rest; `stages` has each.
class PointSampler final : public Sampler {
 public:
  // The frames outlive it.
  PointSampler(const SceneFrames& frames, const TradePoint& point, Task task, int threads);

  SampleReply sample(const SampleRequest& request) override;

 private:
  void play_up_to(std::size_t frame);

  const SceneFrames* frames_;
  TradePoint point_;
  Executor executor_;
  FramePipeline pipeline_;
  bool started_ = false;
};

}  // namespace touchstone
