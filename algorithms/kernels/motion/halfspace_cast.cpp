// The time at which a body meets a half-space, in closed form.
#include "algorithms/kernels/motion/halfspace_cast.h"

#include <algorithm>
#include <limits>

#include "algorithms/kernels/minkowski/halfspace.h"
#include "algorithms/kernels/motion/keep_to_tolerance.h"

namespace touchstone {

void cast_halfspace(const SupportShape<double>& a, const Pose& pose_a, const Motion& motion_a,
                    const SupportShape<double>& b, const Pose& pose_b, const Motion& motion_b,
                    const HalfspaceCastGoal& goal, CastOutcome& outcome) {
  Outcome start;
  const bool two = a.core == SupportCore::halfspace;
  const auto solve = two ? solve_halfspaces<double> : solve_halfspace<double>;
  solve(a, pose_a, b, pose_b, Task::distance, start);
  outcome.iterations = 0;
  outcome.status = Status::ok;
  if (start.answer == Answer::unknown) {
    outcome.status = Status::not_converged;
    outcome.lower = 0;
    return;
  }
  if (start.answer == Answer::overlapping) {
    outcome.answer = CastAnswer::hit;
    outcome.toi = outcome.lower = outcome.upper = 0;
    if (goal.start == StartContact::counts) return;
    // A depth is needed to tell whether they approach; half-spaces that are not parallel have none.
    solve(a, pose_a, b, pose_b, Task::penetration, start);
    if (!(start.distance < 0)) return;
  }
  const Vec3d velocity = motion_b.displacement - motion_a.displacement;
  const double along = start.normal.dot(velocity);
  // The normal is off by a few roundings, the product and the difference by as many.
  const double doubt = 32 * std::numeric_limits<double>::epsilon() * velocity.stableNorm();
  const double hidden = start.upper - start.lower + 2 * doubt;
  const double tolerance =
      std::max(goal.tolerance.value_or(two ? 0 : 1e-9 * (a.size + a.radius)), hidden);
  const double lower_end = start.lower + along - doubt;
  const bool resting = start.lower <= 0;
  if (goal.start == StartContact::approach && resting &&
      std::min(start.lower, lower_end) >= -tolerance) {
    outcome.answer = CastAnswer::miss;
    outcome.toi = outcome.lower = outcome.upper = CastOutcome::none;
    return;
  }
  if (start.answer == Answer::overlapping) return;
  if (!resting && lower_end > 0) {
    outcome.answer = CastAnswer::miss;
    return;
  }
  if (resting && start.upper > tolerance) {
    outcome.status = Status::not_converged;
    outcome.lower = 0;
    return;
  }
  constexpr double outward = 8 * std::numeric_limits<double>::epsilon();
  const double fastest = -along + doubt, slowest = -along - doubt;
  outcome.answer = CastAnswer::hit;
  outcome.lower = resting ? 0 : std::min(start.lower / fastest * (1 - outward), 1.0);
  outcome.toi = outcome.lower;
  const double upper = std::max(start.upper, 0.0) / slowest * (1 + outward);
  if (start.upper <= 0) {
    outcome.upper = 0;
  } else if (slowest > 0 && upper <= 1) {
    outcome.upper = upper;
  }
  outcome.normal = start.normal;
  outcome.point = start.witness_b + outcome.toi * motion_b.displacement;
  keep_to_tolerance(goal.tolerance, hidden, outcome);
}

}  // namespace touchstone
