// The sampler of a broad phase, and makers of the samplers of broad and narrow phases, each with
// the executor that it runs on.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "algorithms/core/executor/executor.h"
#include "harness/measure/allocations.h"
#include "harness/measure/block_input.h"
#include "harness/measure/narrow_choice.h"
#include "harness/measure/sampler.h"
#include "harness/measure/worker.h"

namespace touchstone::measure {

// Frame 0 is built and each other frame is an update of the one before, as in a scene that is
// played again and again. The build of frame 0 is outside a sample of updates, and so is frame 0;
// with `rebuild`, or when there is no other frame, every frame is built and counts. When a window
// does not continue the one before, the frames up to it are played before the clock starts.
//
// The end of the frame before a build, and what a build does not need its boxes for, are outside the
// clock (BroadPhase::discard and prepare).
//
// The durations are `build` or `update`, and `find_pairs`. A `hashed` request of one frame has
// `convert` too: the part of a library's build or update that converts boxes to its own types, run
// and timed again by itself.
class BroadSampler final : public Sampler {
 public:
  BroadSampler(const BroadPhaseEntry& entry, const BlockInput& input, bool rebuild,
               Executor& executor);

  SampleReply sample(const SampleRequest& request) override;
  // Plays one frame, which may be frame 0; sink() holds its pairs until the next call.
  SampleReply play(std::size_t frame);
  const PairSink& sink() const { return sink_; }
  // Plays one frame without a clock, and counts the calls of the heap.
  struct FrameAllocations {
    Allocations prepare, query;
  };
  FrameAllocations count_allocations(std::size_t frame);

 private:
  void step(std::size_t frame, SampleReply& reply);
  void make_ready(std::size_t frame);
  void prepare(std::size_t frame);
  double time_conversion(std::size_t frame);
  void play_up_to(std::size_t frame);
  bool is_built(std::size_t frame) const { return rebuild_ || frame == 0; }

  const BlockInput* input_;
  bool rebuild_;
  std::unique_ptr<BroadPhase> algorithm_;
  PairSink sink_;
  std::ptrdiff_t at_ = -1;  // the frame that the algorithm holds; -1: none yet
};

// The executor of a sampler.
struct Threads {
  int width = 1;
  ExecutorKind kind = usual_executor;
};

// All arguments by reference, and the sets, outlive the maker and its samplers.
Worker::Make broad_maker(const BroadPhaseEntry& entry, const BlockInput& input, bool rebuild,
                         Threads threads);
Worker::Make narrow_maker(const NarrowChoice& choice, const BlockInput& input,
                          std::span<const NarrowSet> sets, Threads threads);

}  // namespace touchstone::measure
