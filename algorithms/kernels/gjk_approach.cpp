#include "algorithms/kernels/gjk_approach.h"

#include <algorithm>

#include "algorithms/kernels/nesterov_direction.h"
#include "algorithms/kernels/simplex_walk.h"

namespace touchstone {
namespace {

// Whether the quick walk is all that was needed; if not, how far it came.
template <class Scalar>
bool walk_first(SupportPair<Scalar>& pair, const ApproachGoal<Scalar>& goal,
                Approach<Scalar>& found) {
  using End = typename Approach<Scalar>::End;
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  const WalkGoal first{.only_apart = goal.task != Task::distance,
                       .most_iterations = goal.most_iterations};
  const Walk<Scalar> quick = walk(pair, first, goal.tolerance);
  found.iterations = quick.iterations;
  found.simplex = quick.simplex;
  if (quick.end == WalkEnd::apart) {
    found.lower = quick.lower;
    found.end = End::decided;
    return true;
  }
  found.upper = 0;
  found.end = End::contact;
  if (quick.end == WalkEnd::inside) {
    found.nearest.inside = true;
    found.nearest.distance = 2 * rounding;  // at least
    return true;
  }
  if (found.simplex.size == 0) return false;
  found.nearest = reduce_to_nearest(found.simplex);
  if (found.nearest.inside || !(found.nearest.distance > rounding)) return true;
  found.upper = found.nearest.distance;
  found.end = End::cap;
  if (quick.end != WalkEnd::near || goal.is_open(pair, found.nearest.distance, quick.lower)) {
    return false;
  }
  found.lower = quick.lower;
  found.end = End::decided;
  return true;
}

}  // namespace

template <class Scalar>
Approach<Scalar> approach(SupportPair<Scalar>& pair, const ApproachGoal<Scalar>& goal) {
  using End = typename Approach<Scalar>::End;
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  const Task task = goal.task;
  // Steps that do not come nearer may still turn the plane; but not for ever.
  constexpr int patience = 8;
  const Scalar radius = pair.radius();
  Approach<Scalar> found;
  found.lower = -std::numeric_limits<Scalar>::infinity();
  Simplex<Scalar>& simplex = found.simplex;

  const Scalar length = pair.centre_b().norm();
  Vec3<Scalar> direction =
      length > 0 ? Vec3<Scalar>(pair.centre_b() / length) : Vec3<Scalar>::UnitX();
  if (goal.momentum == Momentum::none && !goal.duality_gap) {
    if (walk_first(pair, goal, found)) return found;
    if (simplex.size > 0) direction = -found.nearest.direction;
  }
  int stalled = 0;
  bool accelerated = goal.momentum == Momentum::nesterov;
  NesterovDirection<Scalar> nesterov(pair.is_polytope(), -pair.centre_b());
  while (found.iterations < goal.most_iterations) {
    ++found.iterations;
    const DifferencePoint<Scalar> point = pair.support(direction);
    const Scalar lower = -direction.dot(point.difference);
    const bool of_normal = task == Task::penetration && !accelerated;
    found.lower = of_normal ? lower : std::max(found.lower, lower);
    const bool apart = found.lower - radius > rounding;
    // Comparisons are written so that NaN ends the loop.
    const bool open = goal.is_open(pair, found.nearest.distance, found.lower) || simplex.size == 0;
    switch (task) {
      case Task::intersect:
        if (apart) found.end = End::decided;
        break;
      case Task::distance:
        if (apart && !open) found.end = End::decided;
        break;
      case Task::penetration:
        if (apart || (!open && found.lower > rounding)) found.end = End::decided;
        break;
    }
    bool known = false;
    for (int i = 0; i < simplex.size; ++i) {
      known = known || simplex.points[i].difference == point.difference;
    }
    // The paper's stop: the support point is no nearer to the origin along the nearest point.
    const bool spent =
        accelerated && simplex.size > 0 &&
        !goal.is_open(pair, found.nearest.distance, found.nearest.direction.dot(point.difference));
    // A shallow overlap of round shapes: the bound is to hold along the normal that is reported.
    const bool oblique = accelerated && task == Task::penetration && !apart && !open;
    if (accelerated && (found.end != End::decided || oblique) && (known || spent || oblique)) {
      accelerated = false;
      found.end = End::cap;
      direction = -found.nearest.direction;
      continue;
    }
    if (found.end == End::decided) return found;
    if (known) {
      found.end = End::no_better;
      return found;
    }

    simplex.points[simplex.size++] = point;
    found.nearest = reduce_to_nearest(simplex);
    if (found.nearest.inside || !(found.nearest.distance > rounding)) {
      found.upper = 0;
      found.end = End::contact;
      return found;
    }
    if (!(found.nearest.distance < found.upper) && ++stalled > patience) {
      found.end = End::no_better;
      return found;
    }
    found.upper = std::min(found.upper, found.nearest.distance);
    if (task != Task::penetration && found.upper - radius < -rounding) {
      found.end = End::decided;
      return found;
    }
    direction = -found.nearest.direction;
    if (accelerated) {
      const Vec3<Scalar> nearest = found.nearest.distance * found.nearest.direction;
      const Vec3<Scalar> ahead = nesterov.next(nearest, point.difference);
      if (ahead.squaredNorm() > Scalar{0.5}) direction = ahead;
    }
  }
  return found;
}

template Approach<float> approach(SupportPair<float>&, const ApproachGoal<float>&);
template Approach<double> approach(SupportPair<double>&, const ApproachGoal<double>&);

}  // namespace touchstone
