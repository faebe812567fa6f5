// Plays a configuration's frames as samples.
#include "harness/trade/point_sampler.h"

#include <algorithm>

#include "harness/base/hash.h"

namespace touchstone::trade {

PointSampler::PointSampler(const SceneFrames& frames, const TradePoint& point, Task task,
                           int threads, ExecutorKind executor)
    : frames_(&frames),
      point_(point),
      executor_(threads, Pinning::one_a_thread, executor),
      pipeline_(frames, *point_.stand_ins, point_.configuration, task, executor_) {}

void PointSampler::play_up_to(std::size_t frame) {
  if (!started_ || pipeline_.frame() > frame) pipeline_.start(0);
  started_ = true;
  while (pipeline_.frame() < frame) pipeline_.advance();
}

measure::SampleReply PointSampler::sample(const measure::SampleRequest& request) {
  measure::SampleReply reply;
  reply.contacts = 0;
  std::size_t frame = request.frame;
  for (std::uint32_t i = 0; i < request.frames; ++i) {
    if (frame == frames_->frames.size()) frame = frames_->is_static() ? 0 : 1;
    if (frames_->is_static()) {
      pipeline_.start(0);
    } else {
      play_up_to(frame - 1);
      pipeline_.advance();
    }
    ++frame;
    for (std::size_t k = 0; k < stage_names.size(); ++k) {
      reply.durations.add(stage_names[k], pipeline_.seconds()[k]);
    }
    reply.pairs += static_cast<std::int64_t>(pipeline_.pairs().size());
    reply.pair_hash += base::pair_hash(pipeline_.pairs());
    reply.contacts += std::ranges::count_if(pipeline_.answers(), [](const PairAnswer& answer) {
      return grade::is_contact(answer.answer);
    });
  }
  return reply;
}

}  // namespace touchstone::trade
