// Conservative advancement with the one plane that there is: points of the body fall towards it no faster than the
// bodies close along its normal, and their turn adds.
//
// The gap at a time is bounded by the query of poses as they were placed, which are off by placement_rounding.
#include "algorithms/kernels/motion/advancement/halfspace_advancement.h"

#include <algorithm>
#include <limits>

#include "algorithms/kernels/minkowski/halfspace.h"
#include "algorithms/kernels/motion/keep_to_tolerance.h"

namespace touchstone {
namespace {

constexpr double inward = 1 - 64 * std::numeric_limits<double>::epsilon();

class HalfspaceGap {
 public:
  HalfspaceGap(const MovingBody& a, const MovingBody& b)
      : bounds_(a, b), turning_(a, bounds_.angle_a()), rounding_(bounds_.placement_rounding()) {}

  // Bounds on the gap (metres), where the query has some, with its normal and points from a's origin.
  Outcome at(double time) const {
    const MovingBody &a = bounds_.a(), &b = bounds_.b();
    const Pose pose_a = {turning_.at(time), Vec3d::Zero()};
    const Pose pose_b = {b.pose->rotation, bounds_.offset(time)};
    Outcome found;
    solve_halfspace<double>(*a.shape, pose_a, *b.shape, pose_b, Task::distance, found);
    if (found.answer == Answer::overlapping) {
      solve_halfspace<double>(*a.shape, pose_a, *b.shape, pose_b, Task::penetration, found);
    }
    found.lower -= rounding_;
    found.upper += rounding_;
    return found;
  }

  // At least how fast the gap falls (metres in the whole time).
  double speed(const Vec3d& normal) const {
    const double turn = normal.cross(bounds_.a().motion->rotation_vector).norm();
    return (turn * bounds_.reach_a() - normal.dot(bounds_.displacement()) +
            64 * std::numeric_limits<double>::epsilon() * bounds_.speed()) /
           inward;
  }

  Vec3d to_world(const Vec3d& point, double time) const { return bounds_.to_world(point, time); }

 private:
  MotionBounds bounds_;
  TurningPose turning_;
  double rounding_;
};

}  // namespace

void advance_onto_halfspace(const MovingBody& a, const MovingBody& b, const AdvancementGoal& goal,
                            CastOutcome& outcome) {
  outcome = {};
  outcome.iterations = 0;
  if (b.motion->turns() || a.shape->core == SupportCore::halfspace) {
    outcome.status = Status::unsupported;
    return;
  }
  const HalfspaceGap gaps(a, b);
  outcome.status = Status::not_converged;
  double time = 0;
  for (; outcome.iterations < goal.most_steps; ++outcome.iterations) {
    const Outcome found = gaps.at(time);
    const double hidden = 2 * (found.upper - found.lower);
    const double tolerance =
        std::max(goal.tolerance.value_or(1e-9 * (a.shape->size + a.shape->radius)), hidden);
    outcome.lower = time;
    if (found.upper <= tolerance) {
      outcome.status = Status::ok;
      outcome.answer = CastAnswer::hit;
      outcome.toi = time;
      outcome.normal = found.normal;
      outcome.point = gaps.to_world(found.witness_b, time);
      if (found.upper <= 0) {
        outcome.upper = time;
        return;
      }
      const double speed = gaps.speed(found.normal);
      for (double step = tolerance / speed, later = time; later < 1 && step > 0; step *= 8) {
        later = std::min(time + step, 1.0);
        if (!(gaps.at(later).upper <= 0)) continue;
        outcome.upper = later;
        break;
      }
      keep_to_tolerance(goal.tolerance, hidden, outcome);
      return;
    }
    const double gap = found.lower, speed = gaps.speed(found.normal);
    // This form of the comparison ends the search for NaN.
    if (!(gap > 0)) return;
    if (gap > speed * (1 - time)) {
      outcome.status = Status::ok;
      outcome.answer = CastAnswer::miss;
      outcome.lower = CastOutcome::none;
      return;
    }
    const double next = time + gap / speed * inward;
    if (!(next > time)) return;
    time = next;
  }
}

}  // namespace touchstone
