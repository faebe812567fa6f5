// The contract of a broad phase: all pairs of boxes that overlap.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/broad_phase_work.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/status.h"

namespace touchstone {

// What is new in a frame. `boxes` is the whole new array; a body's id is its place in it. The three
// lists are disjoint and in ascending order; every box that is in none of them is bit for bit what
// it was. The array grows when bodies with new ids come in, and never shrinks.
struct FrameChange {
  std::span<const Aabb> boxes;
  std::span<const std::uint32_t> moved;     // present before and now
  std::span<const std::uint32_t> inserted;  // not present before
  std::span<const std::uint32_t> removed;   // no longer present: boxes[id] is the empty box
};

// Called as build, find_pairs, then (update, find_pairs) for each further frame; `build` may come
// again at any time and starts afresh. The harness times the three apart.
//
// The boxes handed to build or update stay alive and unchanged until the next build or update.
// Boxes are finite, with min <= max, or empty: an empty slot has no body and is skipped. There may
// be none.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  virtual void build(std::span<const Aabb> boxes) = 0;
  virtual void update(const FrameChange& change) = 0;

  // Writes every pair of boxes whose closed boxes share a point, each once, a < b, in an order that
  // does not depend on the executor's width. A pair is never dropped: grow and go on, or return
  // Status::capacity. Status::ok otherwise.
  virtual Status find_pairs(PairSink& sink) = 0;

  // What find_pairs does, on what was last built or updated. Counted when it is asked for, by going
  // over the structure again, so that find_pairs itself does not have to; not to be asked for
  // inside the clock.
  virtual BroadPhaseWork work() const { return {}; }
};

// A broad phase of a library that has types of its own for boxes.
class PeerBroadPhase : public BroadPhase {
 public:
  // Turns these boxes, none of them empty, into what the library takes, in memory of its own, and
  // does nothing else. It repeats what build and update do to the boxes that are new to them, so that
  // the harness can time the conversion apart.
  virtual void convert(std::span<const Aabb> boxes) = 0;
};

struct BroadPhaseEntry {
  AlgorithmInfo info;
  // Null where it is not built. The executor outlives the algorithm.
  std::function<std::unique_ptr<BroadPhase>(Executor&)> make;
};

}  // namespace touchstone
