// The sampler of a narrow phase, the order of its pairs, and the hash of its answers.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/core/outcome.h"
#include "harness/base/hash.h"
#include "harness/grade/pair_groups.h"
#include "harness/measure/allocations.h"
#include "harness/measure/block_input.h"
#include "harness/measure/narrow_choice.h"
#include "harness/measure/sampler.h"

namespace touchstone::measure {

// It does not depend on the order of the pairs or on the number of threads. It is a sum modulo 2^64
// over the pairs, so the hash of several frames is the sum of their hashes.
inline std::uint64_t outcome_hash(const grade::PairGroup& group,
                                  std::span<const Outcome> outcomes) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    std::uint64_t hash = base::mix((std::uint64_t{group.first[i]} << 32) + group.second[i]);
    hash = base::mix(hash ^ (static_cast<std::uint64_t>(outcome.answer) << 8) ^
                     static_cast<std::uint64_t>(outcome.status));
    // Every NaN has the same hash: it means that there is no number.
    if (!std::isnan(outcome.distance)) {
      hash = base::mix(hash ^ std::bit_cast<std::uint64_t>(outcome.distance));
    }
    sum += hash;
  }
  return sum;
}

// The hash of the lists of pairs of parts, which is added to that of the outcomes; 0 without lists.
// `lists` may go on behind those of the group.
inline std::uint64_t list_hash(const grade::PairGroup& group,
                               std::span<const grade::PartList> lists) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; !lists.empty() && i < group.size(); ++i) {
    const std::uint64_t pair =
        base::mix((std::uint64_t{group.first[i]} << 32) + group.second[i] + 1);
    sum += base::mix(base::mix(pair ^ lists[i].count) ^ lists[i].hash);
  }
  return sum;
}

// The hash of the pairs of a group, made of their pair_hash.
inline std::uint64_t group_hash(const grade::PairGroup& group) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::uint32_t a = group.first[i];
    const std::uint32_t b = group.second[i];
    sum += base::mix((std::uint64_t{a < b ? a : b} << 32) + (a < b ? b : a));
  }
  return sum;
}

// Two bodies have the same slot of memory in every frame in which they are a pair. The slots are
// cut into tasks, and the pairs of a frame are ordered so that those of a task are together: then
// one worker can solve a task's pairs frame after frame, and is the only one that writes to their
// memory.
class WarmPairs {
 public:
  WarmPairs(const NarrowSet& set, std::size_t slots_a_task);

  struct Frame {
    grade::PairGroup pairs;            // the pairs in the order of the set within each task
    std::vector<std::uint32_t> slots;  // one for each pair
    // for each pair, its index in the set's frame; empty: the same order
    std::vector<std::uint32_t> places;
    std::vector<std::size_t> begins;  // the beginning of each task's pairs, and the end of the last
  };
  const Frame& frame(std::size_t i) const { return frames_[i]; }
  std::size_t slots() const { return slots_; }
  std::size_t tasks() const { return tasks_; }

 private:
  std::size_t slots_ = 0, tasks_ = 0;
  std::vector<Frame> frames_;
};

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
