// Runs the broad phases of a block, frame by frame, and checks what they find.
#pragma once

#include <memory>
#include <random>
#include <span>
#include <vector>

#include "algorithms/broad_phase.h"
#include "harness/run/pair_check.h"
#include "harness/run/run_context.h"
#include "harness/scene/player.h"

namespace touchstone {

class BroadRunner {
 public:
  BroadRunner(const RunContext& context, Executor& executor);

  // The frame's true pairs, sorted: by the naive broad phase, which tests every pair of boxes.
  std::vector<IndexPair> truth(std::span<const Aabb> boxes);

  // One frame of every algorithm that is still in, in the order of `shuffle`: build or update, then
  // find_pairs, each timed apart; then, untimed, the check against `truth`. `before` are the boxes
  // of the frame before; empty in the first.
  void run_frame(const ScenePlayer& player, std::span<const IndexPair> truth,
                 std::span<const Aabb> before, std::mt19937_64& shuffle);

  // What each algorithm found in this frame, in its own order.
  struct Found {
    const BroadPhaseEntry* entry;
    std::vector<IndexPair> pairs;
  };
  const std::vector<Found>& found() const { return found_; }

 private:
  struct Contestant {
    const BroadPhaseEntry* entry;
    std::unique_ptr<BroadPhase> algorithm;
    PairSink sink;
    bool out = false;  // it took longer than the time limit, or threw
  };

  void run(Contestant& contestant, const ScenePlayer& player, std::span<const IndexPair> truth,
           std::span<const Aabb> before);
  void check(const Contestant& contestant, const ScenePlayer& player, std::vector<IndexPair> pairs,
             std::span<const IndexPair> truth, std::span<const Aabb> before);

  RunContext context_;
  std::unique_ptr<BroadPhase> reference_;
  std::vector<Contestant> contestants_;
  std::vector<Found> found_;
};

}  // namespace touchstone
