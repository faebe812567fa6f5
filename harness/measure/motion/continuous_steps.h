// The continuous way through a scene's steps: moving boxes, a broad phase on what they sweep, the test
// of moving boxes, and casts of what is left.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/moving_pairs.h"
#include "algorithms/registry.h"
#include "harness/grade/pair_groups.h"
#include "harness/measure/motion/motion_input.h"

namespace touchstone::measure {

// A pair goes to the first cast that takes its kinds and its motion.
struct ContinuousChoice {
  const BroadPhaseEntry* broad = nullptr;
  std::vector<const CastEntry*> casts;
  CastSettings settings;
  int parts = 0;  // parts of a step for the broad phase; 0: the cheapest
};

class ContinuousSteps {
 public:
  // Binds the shapes. The input and the executor outlive it.
  ContinuousSteps(const MotionInput& input, ContinuousChoice choice, Executor& executor);

  // Plays all steps. This is timed.
  void play();
  // The answers of the last play.
  std::vector<StepAnswer> answers() const;

 private:
  // Pairs of one kind pair that one cast takes, and their outcomes. Plays write over those of the
  // play before, in the same memory.
  struct Batch {
    std::size_t cast = 0;
    grade::PairGroup pairs;
    std::vector<CastOutcome> outcomes;
  };
  struct Step {
    std::vector<Batch> batches;
    std::vector<IndexPair> not_taken;
  };

  void place_boxes(const scene::MotionStep& step);
  void group(const scene::MotionStep& motions, Step& step);
  void cast(const scene::MotionStep& motions, Step& step);

  const MotionInput* input_;
  ContinuousChoice choice_;
  Executor* executor_;
  MovingPairs moving_;
  std::vector<std::vector<std::unique_ptr<Cast>>> casts_;  // by cast and worker
  std::vector<MovingBox> boxes_;
  std::vector<Aabb> swept_;  // what boxes_ sweep in the step
  std::vector<IndexPair> pairs_;
  std::array<grade::PairGrouping, 2> groups_;  // pairs that turn, and those that do not
  std::vector<Step> steps_;
};

}  // namespace touchstone::measure
