// The discrete way through a scene's steps: substeps, at the end of each of which bodies stand still
// while a broad phase and a narrow phase look at them. What touches only in between is missed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/measure/motion/motion_input.h"

namespace touchstone::measure {

// A pair goes to the first narrow phase that takes its kinds.
struct DiscreteChoice {
  const BroadPhaseEntry* broad = nullptr;
  std::vector<const NarrowPhaseEntry*> narrow;
  NarrowPhaseSettings settings;
  int substeps = 1;
};

class DiscreteSteps {
 public:
  // Binds the shapes, and looks at the bodies at the start of each step, as the last substep of the
  // step before would have. The input and the executor outlive it.
  DiscreteSteps(const MotionInput& input, DiscreteChoice choice, Executor& executor);

  // Plays all steps. This is timed.
  void play();
  // The answers of the last play, with what touched at the start of each step.
  std::vector<StepAnswer> answers() const;

 private:
  void place(const scene::MotionStep& step, double time);
  void search(bool is_first);
  void look(StepAnswer& answer);

  const MotionInput* input_;
  DiscreteChoice choice_;
  Executor* executor_;
  std::unique_ptr<BroadPhase> broad_;
  std::vector<std::vector<std::unique_ptr<NarrowPhase>>> narrow_;  // by narrow phase and worker
  std::vector<std::uint32_t> movers_;
  std::vector<Pose> poses_;
  std::vector<Aabb> boxes_[2];  // of this substep and of the one before
  int current_ = 0;
  PairSink found_;
  std::vector<StepAnswer> starts_, steps_;
};

}  // namespace touchstone::measure
