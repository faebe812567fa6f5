// The lower bound on the time of a broad phase that sorts: `limit` in the results. It may include
// core and kernels/sorting.
#pragma once

#include <memory>
#include <span>

#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

// It is not a broad phase, since the pairs are given. Its time is that of a radix sort of a 32-bit
// key for each box, of gathering the boxes in that order, and of writing the pairs.
class BroadPhaseLimit {
 public:
  virtual ~BroadPhaseLimit() = default;
  virtual void sort_and_gather(std::span<const Aabb> boxes) = 0;
  virtual void write(std::span<const IndexPair> pairs, PairSink& sink) = 0;
};

// Makes the bound. The executor must outlive it.
std::unique_ptr<BroadPhaseLimit> make_broad_phase_limit(Executor& executor);

}  // namespace touchstone
