// What no broad phase that sorts can do without: the yardstick beside the contestants.
#pragma once

#include <memory>
#include <span>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

// Not a broad phase: it is told the pairs. Its time is that of a radix sort of a 32-bit key for
// each box, of gathering the boxes in that order, and of writing the pairs.
class BroadPhaseLimit {
 public:
  virtual ~BroadPhaseLimit() = default;
  virtual void sort_and_gather(std::span<const Aabb> boxes) = 0;
  virtual void write(std::span<const IndexPair> pairs, PairSink& sink) = 0;
};

// The executor outlives it.
std::unique_ptr<BroadPhaseLimit> make_broad_phase_limit(Executor& executor);

}  // namespace touchstone
