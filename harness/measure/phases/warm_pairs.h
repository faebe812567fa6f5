// The pairs of a set in the order for warm starts: each has a memory of its own over all frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/measure/phases/block_input.h"

namespace touchstone::measure {

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

}  // namespace touchstone::measure
