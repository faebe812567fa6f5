// The loop of gjk_distance.h for one choice of support functions, `Cores`. Included by
// generic_support.cpp and gjk-templated. Everything is local to the including file, so that
// functions with one caller are inlined.
#include "algorithms/kernels/gjk/gjk_distance.h"

#include <algorithm>

#include "algorithms/kernels/gjk/box_face.h"
#include "algorithms/kernels/gjk/gjk_iteration.h"
#include "algorithms/kernels/gjk/nesterov_direction.h"
#include "algorithms/kernels/gjk/separation_along.h"

namespace touchstone {
namespace {

// Sets the end from the simplex's nearest point. Returns true if the cores share a point, up to
// rounding.
template <class Scalar>
bool is_contact(GjkDistanceResult<Scalar>& found) {
  using End = typename GjkDistanceResult<Scalar>::End;
  found.upper = 0;
  found.end = End::contact;
  if (found.nearest.inside || !(found.nearest.distance > SupportPair<Scalar>::rounding))
    return true;
  found.upper = found.nearest.distance;
  found.end = End::cap;
  return false;
}

template <class Scalar>
void take_inside(GjkDistanceResult<Scalar>& found) {
  found.upper = 0;
  found.end = GjkDistanceResult<Scalar>::End::contact;
  found.nearest.inside = true;
  found.nearest.distance = 2 * SupportPair<Scalar>::rounding;  // a lower bound
}

// Returns true if the plane with this normal, from a to b, suffices.
template <class Scalar>
bool plane_decides(SupportPair<Scalar>& pair, const GjkDistanceGoal<Scalar>& goal,
                   const Vec3<Scalar>& normal, GjkDistanceResult<Scalar>& found) {
  ++found.iterations;
  found.lower = separation_along(pair, normal);
  found.direction = normal;
  const Scalar gap = found.lower - pair.radius();
  if (!(gap > SupportPair<Scalar>::rounding)) return false;
  if (asks_distance(goal.task) && !(gap > goal.margin) &&
      goal.is_open(pair, found.nearest.distance, found.lower)) {
    return false;
  }
  found.end = GjkDistanceResult<Scalar>::End::decided;
  return true;
}

// Returns true if the result of the previous frame suffices; otherwise sets `begin`, the start of
// the iteration.
template <class Scalar>
bool resume(SupportPair<Scalar>& pair, const GjkDistanceGoal<Scalar>& goal,
            const LastFrame<Scalar>& last, FastGjkStart<Scalar>& begin,
            GjkDistanceResult<Scalar>& found) {
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  const bool only_apart = !asks_distance(goal.task);
  const bool round = last.kept.size == 0;
  const bool known = (round || (only_apart && last.kept.size < 4)) && !last.direction.isZero(0);
  if (known && only_apart && plane_decides(pair, goal, last.direction, found)) return true;
  last.kept.place(pair, found.simplex);
  if (found.simplex.size == 4 && is_surely_inside(found.simplex)) {
    take_inside(found);
    return true;
  }
  if (found.simplex.size == 0) {
    if (known) begin.direction = -last.direction;
    return false;
  }
  found.nearest = reduce_to_nearest(found.simplex);
  if (is_contact(found)) return true;
  // A simplex nearer than the radius proves the overlap; only a depth remains to be found.
  if (!asks_depth(goal.task) && found.upper - pair.radius() < -rounding) {
    found.end = GjkDistanceResult<Scalar>::End::decided;
    return true;
  }
  if (!only_apart && plane_decides<Scalar>(pair, goal, -found.nearest.direction, found))
    return true;
  begin.simplex = found.simplex;
  begin.direction = found.nearest.distance * found.nearest.direction;
  return false;
}

// Sets the end to a contact at a face.
template <class Scalar>
bool end_at_face(const std::optional<FaceContact<Scalar>>& face, GjkDistanceResult<Scalar>& found) {
  if (!face) return false;
  found.face = face;
  found.lower = face->lower;
  found.upper = face->upper;
  found.direction = face->normal;
  found.end = GjkDistanceResult<Scalar>::End::at_face;
  return true;
}

// Returns true if the fast iteration suffices; otherwise `found` has its simplex.
template <class Cores, class Scalar>
bool run_fast_gjk(SupportPair<Scalar>& pair, const GjkDistanceGoal<Scalar>& goal,
                  const FastGjkStart<Scalar>& begin, bool numbered,
                  GjkDistanceResult<Scalar>& found) {
  using End = typename GjkDistanceResult<Scalar>::End;
  FastGjkGoal first{.only_apart = !asks_distance(goal.task),
                    .most_iterations = goal.most_iterations,
                    .numbered = numbered,
                    .margin = static_cast<double>(goal.margin)};
  first.ends_at_plane = goal.ends_at_face && begin.simplex.size == 0 &&
                        is_box_with_hull(pair.a().shape(), pair.b().shape());
  // A depth takes less time if the search starts along the line of centres.
  first.ends_behind = asks_depth(goal.task);
  FastGjkResult<Scalar> quick = Cores::fast_gjk(pair, first, goal.tolerance, begin);
  found.iterations += quick.iterations;
  if (quick.end == FastGjkEnd::at_plane) {
    FastGjkStart<Scalar> rest(-pair.centre_b());
    if (quick.lower >= -SupportPair<Scalar>::rounding) {
      if (end_at_face(find_box_face_contact(pair, quick.simplex.points[0]), found)) return true;
      rest.direction = quick.simplex.points[0].difference;
      rest.simplex = quick.simplex;
    }
    first.ends_at_plane = false;
    first.most_iterations -= quick.iterations;
    quick = Cores::fast_gjk(pair, first, goal.tolerance, rest);
    found.iterations += quick.iterations;
  }
  if (quick.moved) found.simplex = quick.simplex;
  if (quick.end == FastGjkEnd::apart) {
    found.lower = quick.lower;
    found.direction = -quick.direction.normalized();
    found.end = End::decided;
    return true;
  }
  if (quick.end == FastGjkEnd::inside) {
    take_inside(found);
    return true;
  }
  if (found.simplex.size == 0) return false;
  if (goal.ends_at_face && quick.end == FastGjkEnd::doubtful && pair.radius() == 0) {
    constexpr Scalar rounding = SupportPair<Scalar>::rounding;
    if (end_at_face(find_face_contact(pair, found.simplex, rounding, rounding), found)) return true;
  }
  if (quick.moved) {
    found.nearest = reduce_to_nearest(found.simplex);
    if (is_contact(found)) return true;
  }
  if (quick.end != FastGjkEnd::near || goal.is_open(pair, found.nearest.distance, quick.lower)) {
    return false;
  }
  found.lower = quick.lower;
  found.direction = -quick.direction.normalized();
  found.end = End::decided;
  return true;
}

template <class Cores, class Scalar>
GjkDistanceResult<Scalar> gjk_distance_by(SupportPair<Scalar>& pair,
                                          const GjkDistanceGoal<Scalar>& goal,
                                          const LastFrame<Scalar>* last) {
  using End = typename GjkDistanceResult<Scalar>::End;
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  const Task task = goal.task;
  // A step that comes no nearer may still turn the plane, but only this many times.
  constexpr int patience = 8;
  const Scalar radius = pair.radius();
  GjkDistanceResult<Scalar> found;
  found.lower = -std::numeric_limits<Scalar>::infinity();
  Simplex<Scalar>& simplex = found.simplex;

  // A depth without a look at the first plane takes less time from the line of centres.
  const bool from_centres =
      goal.momentum == Momentum::nesterov || (asks_depth(goal.task) && !goal.ends_at_face);
  FastGjkStart<Scalar> begin(from_centres ? Vec3<Scalar>(-pair.centre_b()) : start_direction(pair));
  if constexpr (Cores::start_warm) {
    if (last != nullptr && resume(pair, goal, *last, begin, found)) {
      found.warm_hit = true;
      return found;
    }
  }
  // The fast iteration makes more steps in less time; what it leaves open goes on with momentum.
  bool may_switch = goal.momentum == Momentum::where_it_pays && pair.is_smooth();
  if (goal.momentum != Momentum::nesterov && !goal.duality_gap &&
      run_fast_gjk<Cores>(pair, goal, begin, last != nullptr, found)) {
    return found;
  }
  const Scalar length = begin.direction.norm();
  Vec3<Scalar> direction =
      length > 0 ? Vec3<Scalar>(-begin.direction / length) : Vec3<Scalar>::UnitX();
  if (simplex.size > 0) direction = -found.nearest.direction;
  int stalled = 0;
  bool accelerated = goal.momentum == Momentum::nesterov;
  NesterovDirection<Scalar> nesterov(pair.is_polytope(), -pair.centre_b());
  // The unit is up to twice the size of the larger body.
  constexpr Scalar near = 0.5;
  while (found.iterations < goal.most_iterations) {
    ++found.iterations;
    if (may_switch && found.iterations >= 2) {
      may_switch = false;
      accelerated = found.upper - radius < near;
      nesterov = {false, found.nearest.distance * found.nearest.direction};
    }
    const DifferencePoint<Scalar> point = Cores::support(pair, direction);
    const Scalar lower = -direction.dot(point.difference);
    const bool of_normal = asks_depth(task) && !accelerated && !(found.lower - radius > rounding);
    if (of_normal || lower > found.lower) {
      found.lower = lower;
      found.direction = direction;
    }
    const bool apart = found.lower - radius > rounding;
    // The comparisons end the loop for NaN.
    const bool open = goal.is_open(pair, found.nearest.distance, found.lower) || simplex.size == 0;
    switch (task) {
      case Task::intersect:
        if (apart) found.end = End::decided;
        break;
      case Task::distance:
        if (apart && (!open || found.lower - radius > goal.margin)) found.end = End::decided;
        break;
      case Task::penetration:
        if (apart || (!open && found.lower > rounding)) found.end = End::decided;
        break;
      case Task::signed_distance:
        if (found.lower > rounding && (!open || found.lower - radius > goal.margin)) {
          found.end = End::decided;
        }
        break;
    }
    bool known = false;
    for (int i = 0; i < simplex.size; ++i) {
      known = known || simplex.points[i].difference == point.difference;
    }
    // The paper's termination: the support point makes no progress along the nearest point's
    // direction.
    const bool spent =
        accelerated && simplex.size > 0 &&
        !goal.is_open(pair, found.nearest.distance, found.nearest.direction.dot(point.difference));
    // The bound on a shallow overlap of round shapes must hold along the reported normal.
    const bool oblique = accelerated && asks_depth(task) && !apart && !open;
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

    simplex.corners[simplex.size] = {};
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
    if (!asks_depth(task) && found.upper - radius < -rounding) {
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

}  // namespace
}  // namespace touchstone
