// Makers of the samplers of broad and narrow phases, each with the executor that it runs on.
#pragma once

#include <span>

#include "algorithms/core/executor/executor.h"
#include "harness/measure/phases/block_input.h"
#include "harness/measure/phases/narrow_choice.h"
#include "harness/measure/worker.h"

namespace touchstone::measure {

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
