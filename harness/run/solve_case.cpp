#include "harness/run/solve_case.h"

#include <array>
#include <memory>
#include <span>

#include "harness/run/ordered_pair.h"

namespace touchstone {
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

Outcome solve_case(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                   const Case& c, Task task) {
  const std::array<Shape, 2> shapes = {c.shape_a, c.shape_b};
  const std::array<Pose, 2> poses = {c.pose_a, c.pose_b};
  constexpr std::array<std::uint32_t, 2> bodies = {0, 1};
  const bool swap = needs_swap(c.shape_a.kind, c.shape_b.kind);
  const std::span<const std::uint32_t> a(&bodies[swap ? 1 : 0], 1);
  const std::span<const std::uint32_t> b(&bodies[swap ? 0 : 1], 1);
  const PairBatch batch = {.task = task,
                           .kind_a = shapes[a[0]].kind,
                           .kind_b = shapes[b[0]].kind,
                           .first = a,
                           .second = b,
                           .shape_of = bodies,
                           .poses = poses};
  Outcome outcome;
  const std::unique_ptr<NarrowPhase> narrow_phase = entry.make(settings);
  narrow_phase->bind(shapes);
  narrow_phase->solve(batch, {&outcome, 1});
  return asked_for(swap ? swapped(outcome) : outcome, task);
}

}  // namespace touchstone
