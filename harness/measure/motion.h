// Contestants of motion: what they are given, and the continuous and the discrete way through a
// scene's steps.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/moving_box.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/shape.h"
#include "algorithms/moving_pairs.h"
#include "algorithms/registry.h"
#include "harness/grade/pair_groups.h"
#include "harness/scene/kinematics.h"
#include "harness/scene/scene.h"

namespace touchstone::measure {

// What a worker does at a time where it turns bodies or makes their boxes.
inline constexpr std::size_t bodies_a_block = 32;

struct MotionInput {
  std::vector<Shape> shapes;
  std::vector<std::uint32_t> shape_of;  // for each body
  std::vector<scene::MotionStep> steps;
  scene::PairFilter filter;

  std::size_t bodies() const { return shape_of.size(); }
  ShapeKind kind_of(std::uint32_t body) const { return shapes[shape_of[body]].kind; }
  bool turns() const;  // true if some body does in some step
  bool has_halfspaces() const;
};

// `is_linear` leaves the rotations out. Throws InputError as motion_steps does.
MotionInput motion_input(const scene::Scene& scene, const std::filesystem::path& file,
                         bool is_linear);

// Cuts the infinite ends of half-spaces to the region that all other boxes sweep, so that no pair of
// moving boxes is lost or gained and broad phases get a world of its true size. swept[i] is
// swept_box(boxes[i]), before and after.
void cut_halfspaces(const MotionInput& input, std::span<MovingBox> boxes, std::span<Aabb> swept);

// The answer to a step. The pairs are sorted, a < b.
struct StepAnswer {
  std::vector<IndexPair> hits;
  std::vector<IndexPair> misses;   // of casts
  std::vector<IndexPair> unknown;  // pairs that an algorithm gave up, or does not take
  std::size_t pairs = 0;           // pairs that were asked about
};

// The continuous way through a scene's steps: moving boxes, a broad phase on what they sweep, the test
// of moving boxes, and casts of what is left.

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

// The discrete way through a scene's steps: substeps, at the end of each of which bodies stand still
// while a broad phase and a narrow phase look at them. What touches only in between is missed.

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
