// What one contestant does when it is asked for a sample. Only its own calls are inside the clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/broad_phase_work.h"
#include "algorithms/core/executor.h"
#include "harness/base/clock.h"
#include "harness/measure/allocations.h"
#include "harness/measure/block_input.h"
#include "harness/measure/hardware_counters.h"
#include "harness/measure/narrow_choice.h"
#include "harness/measure/warm_pairs.h"

namespace touchstone {

// A window of frames. In a narrow phase's sample the pairs of one set; a broad phase has one input.
struct SampleRequest {
  std::uint32_t set = 0;
  std::uint32_t frame = 0;   // the first
  std::uint32_t frames = 1;  // how many, going round
  bool hashed = false;       // a broad phase's pairs are hashed, between its frames
  bool skips_first = false;  // a narrow phase's window goes round past frame 0
};

// Sums over the window. -1 and NaN where something was not counted.
struct SampleReply {
  double prepare = Outcome::none;  // seconds: build or update; none in a narrow phase
  double query = 0;                // seconds: find_pairs, or the narrow phase
  double convert = Outcome::none;  // seconds: of a peer's `prepare`, where one frame was `hashed`
  std::int64_t pairs = 0;
  std::uint64_t pair_hash = 0;
  std::int64_t contacts = -1;
  std::uint64_t outcome_hash = 0;
  std::int64_t iterations = -1, support_calls = -1;
  BroadPhaseWork work;         // of a broad phase's frame that was `hashed`: to count it takes time
  Status status = Status::ok;  // a broad phase's, the last that was not ok
  std::int64_t peak_kb = -1, minor_faults = -1;
  std::int64_t voluntary_switches = -1, involuntary_switches = -1;
  double waited = Outcome::none;  // seconds for which its threads had no processor
  HardwareCounts hardware;
  // Of a whole pipeline, seconds by its stages (harness/trade); NaN elsewhere.
  std::array<double, 5> stages = {Outcome::none, Outcome::none, Outcome::none, Outcome::none,
                                  Outcome::none};
};

class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual SampleReply sample(const SampleRequest& request) = 0;
};

// Frame 0 is built and each other frame is an update of the one before, as in a scene that is
// played again and again. The build of frame 0 is outside a sample of updates, and so is frame 0;
// with `rebuild`, or where there is no other frame, every frame is built and counts. Frames that a
// window does not follow upon are played up to it before the clock starts.
class BroadSampler final : public Sampler {
 public:
  BroadSampler(const BroadPhaseEntry& entry, const BlockInput& input, bool rebuild,
               Executor& executor);

  SampleReply sample(const SampleRequest& request) override;
  // One frame, frame 0 too; its pairs are in sink() until the next call.
  SampleReply play(std::size_t frame);
  const PairSink& sink() const { return sink_; }
  // The same frame without a clock: what build or update, and what find_pairs asks of the heap.
  struct FrameAllocations {
    Allocations prepare, query;
  };
  FrameAllocations count_allocations(std::size_t frame);

 private:
  void step(std::size_t frame, SampleReply& reply);
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

// The pairs of all frames of the window in one piece of work for the executor. A warm one answers
// each frame with what the frames before left in memory, as in a scene that is played again and
// again: at frame 0 nothing is known, and frames that a window does not follow upon are played up
// to it before the clock starts. So an answer does not depend on the window that it is in.
class NarrowSampler final : public Sampler {
 public:
  // `sets` outlives it: what a request's number means.
  NarrowSampler(const NarrowChoice& choice, const BlockInput& input,
                std::span<const NarrowSet> sets, Executor& executor);

  SampleReply sample(const SampleRequest& request) override;
  // What its queries ask of the heap, without a clock and in this thread.
  Allocations count_allocations(const SampleRequest& request);
  std::span<const Outcome> outcomes() const { return outcomes_; }  // of the last sample, in order

 private:
  struct Chunk {  // pairs of one frame
    PairBatch batch;
    std::size_t first;  // outcome
  };
  struct Warm {  // what is kept of a set
    WarmPairs pairs;
    std::vector<PairMemory> memory;  // of each slot
    std::ptrdiff_t at = -1;          // the frame that was answered last; -1: none
  };
  std::vector<std::size_t> frames_of(const SampleRequest& request) const;
  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes, int worker);

  // Cuts the pairs of the frames.
  std::vector<Chunk> cut(const NarrowSet& set, std::span<const std::size_t> frames) const;
  // Where the chunks of each of the executor's tasks begin, and the end of the last.
  static std::vector<std::size_t> tasks_of(std::span<const Chunk> chunks);
  double solve_cold(const NarrowSet& set, std::span<const std::size_t> frames);

  Warm& warm(std::uint32_t set);
  // Pairs [begin, end) of the frame, as WarmPairs has them.
  PairBatch batch(Warm& warm, std::size_t frame, std::size_t begin, std::size_t end) const;
  // Answers frames that follow one another, and the one before; seconds.
  double play(Warm& warm, Task task, std::span<const std::size_t> frames,
              std::span<Outcome> outcomes);
  // Until the frame before this one is what was answered last; from frame 0 on if need be.
  void play_up_to(Warm& warm, Task task, std::size_t frame);
  double solve_warm(const SampleRequest& request, std::span<const std::size_t> frames);

  const BlockInput* input_;
  std::span<const NarrowSet> sets_;
  Executor* executor_;
  bool starts_warm_;
  std::vector<std::unique_ptr<NarrowPhase>> instances_;  // one a worker
  std::vector<Outcome> outcomes_;
  std::vector<std::optional<Warm>> warm_;  // of each set, once it was asked about
};

}  // namespace touchstone
