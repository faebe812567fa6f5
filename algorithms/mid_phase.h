// The contract of a mid-phase: of two placed bodies with parts, the pairs of parts whose boxes may
// meet. Mid-phases, concave phases and the harness include this.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/pose.h"

namespace touchstone {

// Gets pairs of parts: `a` is a part of the first body, `b` one of the second. Returns false to end
// the search.
using TakePartPairs = std::function<bool(std::span<const IndexPair>)>;

// One instance for each worker, never shared between threads, and for one scene: bodies are added only.
class MidPhase {
 public:
  virtual ~MidPhase() = default;

  // Adds a body, by the boxes of its parts in its own frame (metres, rounded outward), and returns
  // its number: 0 for the first, then one more each. Boxes may be empty, of parts without a point,
  // or infinite.
  virtual std::uint32_t add(std::span<const Aabb> parts) = 0;

  // The parts of a body have moved within it. There are as many as before.
  virtual void refit(std::uint32_t body, std::span<const Aabb> parts) = 0;

  // Hands over each pair of parts at most once, in any order and in portions of any size. No pair is
  // left out whose boxes, each turned and moved with its body as its pose has it literally, share a
  // point. Further pairs may come: boxes may be compared along a few axes only, and are grown by
  // bounds on the rounding. Returns false if `take` ended the search.
  virtual bool find_pairs(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                          const TakePartPairs& take) = 0;
};

struct MidPhaseEntry {
  AlgorithmInfo info;
  // Null if it is not built.
  std::function<std::unique_ptr<MidPhase>()> make;
};

}  // namespace touchstone
