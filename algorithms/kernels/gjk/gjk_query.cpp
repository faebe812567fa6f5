// One query of a pair: the fast GJK iteration for the verdict, the GJK distance loop for bounds,
// and EPA if the cores (the bodies without their rounding radius) share a point.
#include "algorithms/kernels/gjk/gjk_query.h"

#include <algorithm>

namespace touchstone {
namespace {

// Writes a distance between the bodies. All lengths are in the pair's unit: `distance` and its
// bounds are signed; `normal` is from a to b; `a` and `b` are witness points of the cores.
template <class Scalar>
void write(const SupportPair<Scalar>& pair, Scalar distance, Scalar lower, Scalar upper,
           const Vec3<Scalar>& normal, const Vec3<Scalar>& a, const Vec3<Scalar>& b,
           Outcome& outcome) {
  constexpr double rounding = static_cast<double>(SupportPair<Scalar>::rounding);
  outcome.distance = pair.unit() * static_cast<double>(distance);
  outcome.lower = pair.unit() * (static_cast<double>(lower) - rounding);
  outcome.upper = pair.unit() * (static_cast<double>(upper) + rounding);
  outcome.normal = normal.template cast<double>();
  outcome.witness_a = pair.to_world(a + pair.radius_a() * normal);
  outcome.witness_b = pair.to_world(b - pair.radius_b() * normal);
}

}  // namespace

template <class Scalar>
void GjkQuery<Scalar>::solve(const SupportShape<Scalar>& a, const Pose& pose_a,
                             const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                             WarmStart* start, Outcome& outcome) {
  if (task != Task::distance && balls_are_apart(a, pose_a, b, pose_b)) {
    outcome.answer = Answer::separated;
    outcome.status = Status::ok;
    outcome.iterations = outcome.support_calls = 0;
    return;
  }
  SupportPair<Scalar> pair(a, pose_a, b, pose_b);
  outcome.iterations = 0;
  if (task == Task::intersect && start == nullptr && fast_gjk_decides(pair, outcome)) return;
  solve_pair(pair, task, start, outcome);
}

// Finds the verdict for cores with corners and no radius, mostly by the fast iteration. If that
// leaves it open, the distance loop starts again with the rest of the cap.
template <class Scalar>
bool GjkQuery<Scalar>::fast_gjk_decides(SupportPair<Scalar>& pair, Outcome& outcome) const {
  if (!pair.is_polytope() || pair.radius() > 0) return false;
  if (settings_.momentum == Momentum::nesterov || settings_.duality_gap) return false;
  const FastGjkGoal goal{.only_apart = true, .most_iterations = settings_.gjk_cap};
  const FastGjkStart<Scalar> from_the_centres(-pair.centre_b());
  const FastGjkResult<Scalar> found =
      functions_.fast_gjk(pair, goal, tolerance(true), from_the_centres);
  outcome.iterations = found.iterations;
  if (found.end != FastGjkEnd::apart && found.end != FastGjkEnd::inside) return false;
  outcome.answer = found.end == FastGjkEnd::apart ? Answer::separated : Answer::overlapping;
  outcome.status = Status::ok;
  outcome.support_calls = pair.support_calls();
  return true;
}

template <class Scalar>
GjkDistanceResult<Scalar> GjkQuery<Scalar>::gjk_distance_from(SupportPair<Scalar>& pair,
                                                              const GjkDistanceGoal<Scalar>& goal,
                                                              WarmStart* start) {
  const GjkDistanceResult<Scalar> found = functions_.gjk_distance(pair, goal, start);
  if (start == nullptr) return found;
  if (!found.warm_hit) start->keep(found.simplex, found.direction);
  return found;
}

template <class Scalar>
void GjkQuery<Scalar>::solve_pair(SupportPair<Scalar>& pair, Task task, WarmStart* start,
                                  Outcome& outcome) {
  using End = typename GjkDistanceResult<Scalar>::End;
  const GjkDistanceGoal<Scalar> goal{
      .task = task,
      .tolerance = tolerance(pair.is_polytope()),
      .duality_gap = settings_.duality_gap,
      .most_iterations = std::max(1, settings_.gjk_cap - outcome.iterations),
      .momentum = settings_.momentum};
  const GjkDistanceResult<Scalar> found = gjk_distance_from(pair, goal, start);
  outcome.iterations += found.iterations;
  if (found.end == End::contact) {
    solve_contact(pair, found, task, outcome);
  } else {
    const Scalar lower = found.lower - pair.radius();
    const Scalar upper = found.upper - pair.radius();
    outcome.answer = lower > rounding    ? Answer::separated
                     : upper < -rounding ? Answer::overlapping
                                         : Answer::unknown;
    const bool asked = (task == Task::distance && outcome.answer != Answer::overlapping) ||
                       (task == Task::penetration && outcome.answer != Answer::separated);
    // A bound that the answer did not need may be open.
    const bool known = outcome.answer != Answer::unknown &&
                       (!asked || !goal.is_open(pair, found.nearest.distance, found.lower));
    outcome.status = known ? Status::ok : Status::not_converged;
    if (asked) {
      Vec3<Scalar> a = Vec3<Scalar>::Zero();
      Vec3<Scalar> b = Vec3<Scalar>::Zero();
      for (int i = 0; i < found.simplex.size; ++i) {
        a += found.simplex.weights[i] * found.simplex.points[i].a;
        b += found.simplex.weights[i] * found.simplex.points[i].b;
      }
      const Vec3<Scalar> normal = -found.nearest.direction;
      write(pair, found.nearest.distance - pair.radius(), lower, upper, normal, a, b, outcome);
    }
  }
  outcome.support_calls = pair.support_calls();
}

// Solves a pair whose cores share a point, up to rounding.
template <class Scalar>
void GjkQuery<Scalar>::solve_contact(SupportPair<Scalar>& pair,
                                     const GjkDistanceResult<Scalar>& found, Task task,
                                     Outcome& outcome) {
  constexpr Scalar open = 4 * rounding;  // a reported contact may have a gap up to this
  const Scalar radius = pair.radius();
  const bool inside_core = found.nearest.inside && found.nearest.distance > rounding;
  const bool on_core = !found.nearest.inside && distance_from_origin(found.simplex) <= 4 * rounding;
  const bool proven = inside_core || (on_core && radius > 8 * rounding);
  if (proven && task != Task::penetration) {
    outcome.answer = Answer::overlapping;
    outcome.status = Status::ok;
    return;
  }
  ExpansionGoal<Scalar> goal{.tolerance = tolerance(pair.is_polytope()),
                             .doubtful = !inside_core && !on_core};
  if (task != Task::penetration) goal.enough = rounding;
  const Expansion<Scalar> depth = polytope_.expand(pair, found.simplex, goal);
  outcome.iterations += depth.iterations;
  if (depth.end == ExpansionEnd::apart && -depth.upper - radius > rounding) {
    outcome.answer = Answer::separated;
    outcome.status = task == Task::distance ? Status::not_converged : Status::ok;
    return;
  }
  const bool inside =
      proven || depth.lower > rounding || (!goal.doubtful && depth.lower + radius > rounding);
  const bool known = depth.end == ExpansionEnd::converged || depth.end == ExpansionEnd::flat;
  outcome.answer = inside ? Answer::overlapping : Answer::unknown;
  outcome.status = Status::not_converged;
  if (inside && (known || task != Task::penetration)) outcome.status = Status::ok;
  if (!inside && depth.end == ExpansionEnd::flat) outcome.status = Status::degenerate;
  if (task == Task::intersect || (inside && task == Task::distance)) return;
  // If the origin may be outside the polytope, its faces give no bound from the other side.
  const Scalar least = inside ? radius + depth.lower : std::min(radius + depth.lower, -open);
  write(pair, -(radius + depth.upper), -(radius + depth.upper), -least, depth.normal, depth.a,
        depth.b, outcome);
}

template class GjkQuery<float>;
template class GjkQuery<double>;

}  // namespace touchstone
