// Binds an algorithm to one case and solves its pair.
#include "harness/process/queries/solve_case.h"

#include <array>
#include <span>

#include "harness/process/queries/ordered_pair.h"

namespace touchstone::process {
namespace {

Outcome asked_for(Outcome outcome, Task task) {
  const bool apart = outcome.answer == Answer::separated || outcome.answer == Answer::touching;
  const bool met = outcome.answer == Answer::overlapping || outcome.answer == Answer::touching;
  if ((task == Task::distance && apart) || (task == Task::penetration && met)) return outcome;
  outcome.distance = Outcome::none;
  outcome.normal = outcome.witness_a = outcome.witness_b = Vec3d::Constant(Outcome::none);
  return outcome;
}

}  // namespace

BoundCase::BoundCase(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                     const files::Case& c)
    : shapes_{c.shape_a, c.shape_b},
      poses_{c.pose_a, c.pose_b},
      narrow_phase_(entry.make(settings)) {
  narrow_phase_->bind(shapes_);
}

Outcome BoundCase::solve(Task task) {
  constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
  const bool swap = needs_swap(shapes_[0].kind, shapes_[1].kind);
  const std::span<const std::uint32_t> a(&bodies[swap ? 1 : 0], 1);
  const std::span<const std::uint32_t> b(&bodies[swap ? 0 : 1], 1);
  const PairBatch batch = {.kind_a = shapes_[a[0]].kind,
                           .kind_b = shapes_[b[0]].kind,
                           .pairs = {.first = a, .second = b, .shape_of = bodies, .poses = poses_}};
  Outcome outcome;
  narrow_phase_->solve(task, batch, {&outcome, 1});
  return asked_for(swap ? swapped(outcome) : outcome, task);
}

Outcome solve_case(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                   const files::Case& c, Task task) {
  return BoundCase(entry, settings, c).solve(task);
}

}  // namespace touchstone::process
