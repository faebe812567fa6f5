// The sampler of a narrow phase.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "harness/grade/concave/part_list.h"
#include "harness/measure/allocations.h"
#include "harness/measure/phases/block_input.h"
#include "harness/measure/phases/narrow_choice.h"
#include "harness/measure/phases/warm_pairs.h"
#include "harness/measure/sampler.h"

namespace touchstone::measure {

// Samples narrow phases, and concave phases as well: those solve a pair a call, and are always cold.
//
// The pairs of all frames of the window are one piece of work for the executor; the duration is
// `narrow`. A warm narrow phase solves each frame with the memory that the frames before left, as
// in a scene that is played again and again. Its memory is empty at frame 0, and if a window does
// not continue the one before, the frames up to it are played before the clock starts. So an answer
// does not depend on the window that it is in.
class NarrowSampler final : public Sampler {
 public:
  // `sets` outlives it; a request names one of them by its number.
  NarrowSampler(const NarrowChoice& choice, const BlockInput& input,
                std::span<const NarrowSet> sets, Executor& executor);

  SampleReply sample(const SampleRequest& request) override;
  // Counts the heap calls of the queries, without a clock and in this thread.
  Allocations count_allocations(const SampleRequest& request);
  std::span<const Outcome> outcomes() const { return outcomes_; }  // those of the last sample
  // The lists of pairs of parts of the last sample, if they were asked for; otherwise empty.
  std::span<const grade::PartList> lists() const { return lists_; }

 private:
  struct Chunk {  // a run of pairs of one frame
    PairBatch batch;
    std::size_t first;  // the index of its first outcome
  };
  struct Warm {  // the state of a set
    WarmPairs pairs;
    std::vector<PairMemory> memory;  // one for each slot
    std::ptrdiff_t at = -1;          // the last frame solved; -1: none
  };
  std::vector<std::size_t> frames_of(const SampleRequest& request) const;
  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes, int worker);
  // Solves the pairs whose first outcome has this index.
  void solve(record::QueryTask task, const PairBatch& batch, std::size_t first, int worker);
  void solve_concave(ConcaveTask task, const PairBatch& batch, std::size_t first, int worker);

  // Cuts the pairs of the frames into chunks.
  std::vector<Chunk> cut(const NarrowSet& set, std::span<const std::size_t> frames) const;
  // The first chunk of each of the executor's tasks, and the end of the last task.
  std::vector<std::size_t> tasks_of(std::span<const Chunk> chunks) const;
  double solve_cold(const NarrowSet& set, std::span<const std::size_t> frames);

  Warm& warm(std::uint32_t set);
  // Returns the pairs [begin, end) of the frame, in the order of WarmPairs.
  PairBatch batch(Warm& warm, std::size_t frame, std::size_t begin, std::size_t end) const;
  // Solves consecutive frames that continue the one before; returns seconds.
  double play(Warm& warm, Task task, std::span<const std::size_t> frames,
              std::span<Outcome> outcomes);
  // Solves frames until the one before this frame is solved, from frame 0 on if necessary.
  void play_up_to(Warm& warm, Task task, std::size_t frame);
  double solve_warm(const SampleRequest& request, std::span<const std::size_t> frames);

  const BlockInput* input_;
  std::span<const NarrowSet> sets_;
  Executor* executor_;
  bool starts_warm_;
  std::size_t batch_;  // the greatest number of pairs of one call
  std::size_t pairs_a_task_;
  std::vector<std::unique_ptr<NarrowPhase>> instances_;  // one for each worker
  std::vector<std::unique_ptr<ConcavePhase>> concave_;   // or these
  std::vector<std::vector<IndexPair>> found_;            // for each worker, with its memory
  std::vector<Outcome> outcomes_;
  std::vector<grade::PartList> lists_;
  std::vector<std::optional<Warm>> warm_;  // one for each set, made at its first request
};

}  // namespace touchstone::measure
