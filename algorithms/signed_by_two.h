// The signed distance by two calls, for algorithms that find distances and depths apart: the
// distance of all pairs of a batch, then the depth of those that overlap. Narrow phases include
// this.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/narrow_phase.h"

namespace touchstone {

class SignedByTwo {
 public:
  // Solves Task::signed_distance by the tasks distance and penetration of `narrow_phase`. If these
  // contradict each other, the answer is unknown and the status not_converged.
  void solve(NarrowPhase& narrow_phase, const PairBatch& batch, std::span<Outcome> outcomes);

 private:
  static void join(const Outcome& depth, Outcome& outcome);

  std::vector<std::uint32_t> places_, first_, second_, memory_of_;
  std::vector<Outcome> depths_;
};

inline void SignedByTwo::solve(NarrowPhase& narrow_phase, const PairBatch& batch,
                               std::span<Outcome> outcomes) {
  narrow_phase.solve(Task::distance, batch, outcomes);
  places_.clear();
  first_.clear();
  second_.clear();
  memory_of_.clear();
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Answer answer = outcomes[i].answer;
    if (answer != Answer::overlapping && answer != Answer::unknown) continue;
    places_.push_back(static_cast<std::uint32_t>(i));
    first_.push_back(batch.pairs.first[i]);
    second_.push_back(batch.pairs.second[i]);
    if (!batch.memory_of.empty()) memory_of_.push_back(batch.memory_of[i]);
  }
  if (places_.empty()) return;
  PairBatch met = batch;
  met.pairs.first = first_;
  met.pairs.second = second_;
  met.memory_of = memory_of_;
  depths_.assign(places_.size(), {});
  narrow_phase.solve(Task::penetration, met, depths_);
  for (std::size_t k = 0; k < places_.size(); ++k) join(depths_[k], outcomes[places_[k]]);
}

// `outcome` is that of the distance, which was unknown or none.
inline void SignedByTwo::join(const Outcome& depth, Outcome& outcome) {
  const auto sum = [](std::int32_t a, std::int32_t b) { return a < 0 || b < 0 ? -1 : a + b; };
  const std::int32_t iterations = sum(outcome.iterations, depth.iterations);
  const std::int32_t support_calls = sum(outcome.support_calls, depth.support_calls);
  if (depth.answer == Answer::overlapping || depth.answer == Answer::touching) {
    outcome = depth;
  } else if (outcome.answer == Answer::overlapping) {
    outcome = depth.answer == Answer::unknown ? depth : Outcome{.status = Status::not_converged};
  }
  outcome.iterations = iterations;
  outcome.support_calls = support_calls;
}

}  // namespace touchstone
