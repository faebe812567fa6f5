// A played scene as algorithms see it: what they say of its pairs, and what broad phases keep,
// frame by frame.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/registry.h"
#include "harness/files/json_line.h"
#include "harness/grade/pair_groups.h"
#include "harness/measure/block_input.h"
#include "harness/measure/narrow_choice.h"

namespace touchstone::report {

// The pairs of all frames, one frame after the other; within a frame they are grouped by kind, and
// those with a body that is not convex follow.
class ScenePairs {
 public:
  // The input must outlive this object.
  explicit ScenePairs(const measure::BlockInput& input);

  std::size_t frames() const { return groups_.size(); }
  std::size_t start(std::size_t frame) const { return starts_[frame]; }
  std::size_t all() const { return starts_.back(); }

  // Returns the two bodies of each pair of a frame.
  std::vector<std::uint32_t> bodies(std::size_t frame) const;

  // The two functions below ask in a child process. A frame that crashes, or takes more than
  // `time_limit` seconds, is not answered.

  // Returns a verdict for each pair: 0 apart, 1 touching, 2 overlapping, 3 unknown, given up or not
  // asked. Concave phases are asked about the pairs with a body that is not convex, narrow phases
  // about the others.
  std::vector<std::uint8_t> verdicts(const measure::NarrowChoice& choice, double time_limit) const;
  // Returns the signed distance of each pair in metres, by `certified`, or `fused` for concave pairs;
  // NaN if it is unknown or only a bound, or if bodies overlap that are not convex.
  std::vector<double> distances(double time_limit) const;

 private:
  template <class Number, class Take>
  std::vector<Number> ask(const measure::NarrowChoice& choice, record::QueryTask task,
                          double time_limit, Number lost, const Take& take) const;
  std::vector<Outcome> solve(NarrowPhase& narrow, const NarrowPhaseEntry& entry, Task task,
                             std::size_t frame) const;
  std::vector<Outcome> solve(ConcavePhase& phase, const ConcaveEntry& entry, ConcaveTask task,
                             std::size_t frame) const;

  const measure::BlockInput* input_;
  std::vector<std::size_t> starts_ = {0};
  std::vector<std::vector<grade::PairGroup>> groups_;  // by frame, of convex bodies
  std::vector<std::vector<IndexPair>> concave_;        // by frame
};

// Appends the least and the greatest corner.
void append(std::vector<float>& numbers, const Aabb& box);

// Runs each broad phase on all frames. Those that have nothing to show are left out.
files::OrderedJson structure_views(const measure::BlockInput& input,
                                   const std::vector<const BroadPhaseEntry*>& broad);

}  // namespace touchstone::report
