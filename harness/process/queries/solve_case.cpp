// Binds an algorithm to one case and solves its pair.
#include "harness/process/queries/solve_case.h"

namespace touchstone::process {

BoundCase::BoundCase(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                     const files::Case& c)
    : shapes_{c.shape_a, c.shape_b},
      poses_{c.pose_a, c.pose_b},
      query_(entry.make(settings), shapes_) {}

Outcome BoundCase::solve(Task task) {
  return query_.solve_as_batch(
      task, {.shape_a = 0, .pose_a = poses_[0], .shape_b = 1, .pose_b = poses_[1]});
}

Outcome solve_case(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                   const files::Case& c, Task task) {
  return BoundCase(entry, settings, c).solve(task);
}

}  // namespace touchstone::process
