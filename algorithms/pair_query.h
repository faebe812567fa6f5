// One pair as two shapes and two poses, in either order of their kinds, for callers that have no
// batch. The harness and programs that embed a narrow phase include this.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "algorithms/narrow_phase.h"

namespace touchstone {

// One query of bound shapes. `memory`, if there is one, belongs to these two bodies in this order.
struct PairAsked {
  std::uint32_t shape_a;  // place among the bound shapes
  const Pose& pose_a;
  std::uint32_t shape_b;
  const Pose& pose_b;
  PairMemory* memory = nullptr;
};

class PairQuery {
 public:
  // The shapes stay alive and unchanged.
  PairQuery(std::unique_ptr<NarrowPhase> narrow_phase, std::span<const Shape> shapes)
      : narrow_phase_(std::move(narrow_phase)), shapes_(shapes) {
    narrow_phase_->bind(shapes_);
  }

  // Answers one pair, alone (NarrowPhase::solve_alone). The outcome is that of (a, b) whichever
  // order the algorithm takes, and has only what the task gives, and bounds if the algorithm has
  // some. The algorithm must offer the task for these kinds (`offers` of the registry).
  Outcome solve(Task task, const PairAsked& pair) { return ask(task, pair, true); }

  // Answers it as a batch of one pair, as tables are measured.
  Outcome solve_as_batch(Task task, const PairAsked& pair) { return ask(task, pair, false); }

 private:
  Outcome ask(Task task, const PairAsked& pair, bool alone);

  std::unique_ptr<NarrowPhase> narrow_phase_;
  std::span<const Shape> shapes_;
};

// Returns whether a batch takes the pair as (b, a).
constexpr bool needs_swap(ShapeKind a, ShapeKind b) { return b < a; }

inline Outcome PairQuery::ask(Task task, const PairAsked& pair, bool alone) {
  static constexpr std::array<std::uint32_t, 2> bodies{0, 1};
  const ShapeKind kind_a = shapes_[pair.shape_a].kind, kind_b = shapes_[pair.shape_b].kind;
  const bool swap = needs_swap(kind_a, kind_b);
  const std::array<std::uint32_t, 2> shape_of{pair.shape_a, pair.shape_b};
  const std::array<Pose, 2> poses{pair.pose_a, pair.pose_b};
  PairBatch batch = {.kind_a = swap ? kind_b : kind_a,
                     .kind_b = swap ? kind_a : kind_b,
                     .pairs = {.first = std::span(&bodies[swap ? 1 : 0], 1),
                               .second = std::span(&bodies[swap ? 0 : 1], 1),
                               .shape_of = shape_of,
                               .poses = poses}};
  if (pair.memory != nullptr) {
    batch.memory = {pair.memory, 1};
    batch.memory_of = std::span(&bodies[0], 1);
  }
  Outcome outcome;
  if (alone) {
    narrow_phase_->solve_alone(task, batch, 0, outcome);
  } else {
    narrow_phase_->solve(task, batch, {&outcome, 1});
  }
  Outcome given = only_given(task, outcome);
  // The outcome was new, so bounds that nobody asked for are the algorithm's own.
  given.lower = outcome.lower;
  given.upper = outcome.upper;
  return swap ? swapped(given) : given;
}

}  // namespace touchstone
