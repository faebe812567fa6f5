// One query of a pair: the fast GJK iteration for the verdict, the GJK distance loop for bounds,
// and EPA if the cores (the bodies without their rounding radius) share a point.
#include "algorithms/kernels/gjk/gjk_query.h"

#include <algorithm>

#include "algorithms/kernels/gjk/box_face.h"
#include "algorithms/kernels/gjk/first_plane.h"
#include "algorithms/kernels/gjk/simplex_face.h"
#include "algorithms/kernels/minkowski/resolution.h"

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

// Writes `touching` and returns true if the bounds on the signed distance, in the pair's unit, allow
// it.
template <class Scalar>
bool write_if_touching(const SupportPair<Scalar>& pair, Scalar lower, Scalar upper,
                       Outcome& outcome) {
  constexpr double rounding = static_cast<double>(SupportPair<Scalar>::rounding);
  const double unit = pair.unit();
  return write_if_touching(unit * (static_cast<double>(lower) - rounding),
                           unit * (static_cast<double>(upper) + rounding),
                           unit * resolution<Scalar>, outcome);
}

// Writes `touching` and returns true if the contact's bounds allow it.
template <class Scalar>
bool write_if_touching(const SupportPair<Scalar>& pair, const FaceContact<Scalar>& contact,
                       Task task, Outcome& outcome) {
  if (!write_if_touching(pair, contact.lower, contact.upper, outcome)) return false;
  if (task == Task::intersect) return true;
  const DifferencePoint<Scalar> nearest = weighted_mean(contact.triangle);
  write(pair, contact.lower, contact.lower, contact.upper, contact.normal, nearest.a, nearest.b,
        outcome);
  return true;
}

// Writes `touching` and returns true if cores without radius touch in the plane of a triangle of the
// simplex, and both bounds are within rounding, so that no longer search could tell more.
template <class Scalar>
bool is_at_a_face(SupportPair<Scalar>& pair, const Simplex<Scalar>& simplex, Task task,
                  Outcome& outcome) {
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  if (pair.radius() > 0) return false;
  const auto contact = find_face_contact(pair, simplex, rounding, rounding);
  return contact && write_if_touching(pair, *contact, task, outcome);
}

}  // namespace

// Returns the offset of the centres, or writes the answer and returns nothing if the bounding balls
// are apart enough.
template <class Scalar>
[[gnu::always_inline]] inline std::optional<CentreOffset> GjkQuery<Scalar>::offset_unless_apart(
    const SupportShape<Scalar>& a, const Pose& pose_a, const SupportShape<Scalar>& b,
    const Pose& pose_b, Task task, Outcome& outcome) const {
  const bool measured = asks_distance(task);
  const double margin = measured ? settings_.margin : 0;
  if (!(margin < std::numeric_limits<double>::infinity()))
    return centre_offset(a, pose_a, b, pose_b);
  const CentreOffset offset = centre_offset(a, pose_a, b, pose_b);
  const bool apart = measured ? balls_are_apart_by(margin, offset, a, pose_a, b, pose_b)
                              : balls_are_apart(offset, a, pose_a, b, pose_b);
  if (!apart) return offset;
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  if (measured) write_beyond(margin, outcome);
  outcome.iterations = outcome.support_calls = 0;
  return {};
}

template <class Scalar>
void GjkQuery<Scalar>::solve(const SupportShape<Scalar>& a, const Pose& pose_a,
                             const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                             WarmStart* start, Outcome& outcome) {
  const std::optional<CentreOffset> offset =
      offset_unless_apart(a, pose_a, b, pose_b, task, outcome);
  if (!offset) return;
  outcome.iterations = 0;
  if (start == nullptr && task == Task::intersect && takes_fast_gjk(a, b)) {
    return decide(*offset, a, pose_a, b, pose_b, outcome);
  }
  SupportPair<Scalar> pair(*offset, a, pose_a, b, pose_b);
  if (start == nullptr) {
    solve_pair(pair, task, nullptr, outcome);
    return;
  }
  const LastFrame<Scalar> last{*start, start->plane.normal(pose_a, pose_b).template cast<Scalar>()};
  const GjkDistanceResult<Scalar> found = solve_pair(pair, task, &last, outcome);
  if (!found.warm_hit) start->keep(found.simplex);
  // The normal's length is off by rounding as well as the bound.
  const double gap = pair.unit() * static_cast<double>(found.lower - pair.radius() - 2 * rounding);
  if (gap > 0 ? asks_distance(task) && found.warm_hit : found.warm_hit) return;
  start->plane = CarriedPlane::make(found.direction.template cast<double>(), gap, radius_of(a),
                                    pose_a, radius_of(b), pose_b);
}

// Whether `decide` finds the verdict: for cores with corners and no radius.
template <class Scalar>
bool GjkQuery<Scalar>::takes_fast_gjk(const SupportShape<Scalar>& a,
                                      const SupportShape<Scalar>& b) const {
  return a.is_polytope() && b.is_polytope() && a.radius + b.radius == 0 &&
         settings_.momentum != Momentum::nesterov && !settings_.duality_gap;
}

// Finds the verdict, mostly by the first plane or the fast iteration. If they leave it open, the
// distance loop starts again with the rest of the cap.
template <class Scalar>
void GjkQuery<Scalar>::decide(const CentreOffset& offset, const SupportShape<Scalar>& a,
                              const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b,
                              Outcome& outcome) {
  const bool tried = may_be_parted(offset, a, b);
  FirstPlane plane;
  if (tried) {
    plane = first_plane(offset, a, pose_a, b, pose_b);
    if (plane.parts) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
      outcome.iterations = outcome.support_calls = 1;
      return;
    }
  }
  SupportPair<Scalar> pair(offset, a, pose_a, b, pose_b);
  const bool may_rest = is_box_with_hull(a, b);
  FastGjkStart<Scalar> begin(start_direction(pair));
  if (tried) {
    outcome.iterations = 1;
    pair.count_support();
  }
  if (tried && !may_rest) {
    // The iteration goes on where its first step, which was the plane's, ended.
    place_corner(pair, plane.corners, begin.simplex);
    begin.direction = begin.simplex.points[0].difference;
  }
  FastGjkGoal goal{.only_apart = true,
                   .most_iterations = settings_.gjk_cap - outcome.iterations,
                   .ends_at_plane = may_rest};
  FastGjkResult<Scalar> found = functions_.fast_gjk(pair, goal, tolerance(true), begin);
  outcome.iterations += found.iterations;
  if (found.end == FastGjkEnd::at_plane) {
    const auto contact = find_box_face_contact(pair, found.simplex.points[0]);
    if (contact && write_if_touching(pair, *contact, Task::intersect, outcome)) {
      outcome.support_calls = pair.support_calls();
      return;
    }
    goal.ends_at_plane = false;
    goal.most_iterations -= found.iterations;
    FastGjkStart<Scalar> rest(found.simplex.points[0].difference);
    rest.simplex = found.simplex;
    found = functions_.fast_gjk(pair, goal, tolerance(true), rest);
    outcome.iterations += found.iterations;
  }
  if (found.end != FastGjkEnd::apart && found.end != FastGjkEnd::inside) {
    if (is_at_a_face(pair, found.simplex, Task::intersect, outcome)) {
      outcome.support_calls = pair.support_calls();
    } else {
      solve_pair(pair, Task::intersect, nullptr, outcome);
    }
    return;
  }
  outcome.answer = found.end == FastGjkEnd::apart ? Answer::separated : Answer::overlapping;
  outcome.status = Status::ok;
  outcome.support_calls = pair.support_calls();
}

template <class Scalar>
GjkDistanceResult<Scalar> GjkQuery<Scalar>::solve_pair(SupportPair<Scalar>& pair, Task task,
                                                       const LastFrame<Scalar>* last,
                                                       Outcome& outcome) {
  using End = typename GjkDistanceResult<Scalar>::End;
  const GjkDistanceGoal<Scalar> goal{
      .task = task,
      .tolerance = tolerance(pair.is_polytope()),
      .margin = static_cast<Scalar>(settings_.margin / pair.unit()) + rounding,
      .duality_gap = settings_.duality_gap,
      .most_iterations = std::max(1, settings_.gjk_cap - outcome.iterations),
      .momentum = settings_.momentum,
      .ends_at_face = task != Task::intersect};
  const GjkDistanceResult<Scalar> found = functions_.gjk_distance(pair, goal, last);
  outcome.iterations += found.iterations;
  if (found.end == End::at_face) {
    // Bounds within rounding are narrow enough.
    write_if_touching(pair, *found.face, task, outcome);
  } else if (found.end == End::contact) {
    solve_contact(pair, found, task, outcome);
  } else if (asks_distance(task) && found.lower - pair.radius() > goal.margin) {
    write_beyond(pair.unit() * static_cast<double>(found.lower - pair.radius() - rounding),
                 outcome);
  } else {
    const Scalar lower = found.lower - pair.radius();
    const Scalar upper = found.upper - pair.radius();
    outcome.answer = lower > rounding    ? Answer::separated
                     : upper < -rounding ? Answer::overlapping
                                         : Answer::unknown;
    const bool touching =
        outcome.answer == Answer::unknown && write_if_touching(pair, lower, upper, outcome);
    const bool asked = asks_for_number(task, outcome.answer);
    // A bound that the answer did not need may be open.
    const bool known =
        touching || (outcome.answer != Answer::unknown &&
                     (!asked || !goal.is_open(pair, found.nearest.distance, found.lower)));
    outcome.status = known ? Status::ok : Status::not_converged;
    if (asked) {
      const DifferencePoint<Scalar> nearest = weighted_mean(found.simplex);
      const Vec3<Scalar> normal = -found.nearest.direction;
      write(pair, found.nearest.distance - pair.radius(), lower, upper, normal, nearest.a,
            nearest.b, outcome);
    } else if (outcome.answer == Answer::unknown) {
      clear_numbers(outcome);
    }
  }
  outcome.support_calls = pair.support_calls();
  return found;
}

// Solves a pair whose cores share a point, up to rounding.
template <class Scalar>
void GjkQuery<Scalar>::solve_contact(SupportPair<Scalar>& pair,
                                     const GjkDistanceResult<Scalar>& found, Task task,
                                     Outcome& outcome) {
  const Scalar radius = pair.radius();
  // A bound on the cores' distance.
  const Scalar nearest = found.nearest.inside ? Scalar{0} : distance_from_origin(found.simplex);
  const bool inside_core = found.nearest.inside && found.nearest.distance > rounding;
  const bool on_core = !found.nearest.inside && nearest <= 4 * rounding;
  const bool proven = inside_core || (on_core && radius > 8 * rounding);
  if (proven && !asks_depth(task)) {
    outcome.answer = Answer::overlapping;
    outcome.status = Status::ok;
    return;
  }
  if (!proven && radius == 0) {
    // A verdict may be less sharp: EPA takes several times as long.
    const bool verdict = task == Task::intersect;
    const auto contact =
        find_face_contact(pair, found.simplex, verdict ? 2 * rounding : rounding,
                          verdict ? std::numeric_limits<Scalar>::infinity() : rounding);
    if (contact && write_if_touching(pair, *contact, task, outcome)) return;
  }
  ExpansionGoal<Scalar> goal{.tolerance = tolerance(pair.is_polytope()),
                             .away = nearest,
                             .doubtful = !inside_core && !on_core};
  if (!asks_depth(task)) goal.enough = (goal.doubtful ? Scalar{0} : nearest) + rounding;
  const Expansion<Scalar> depth = polytope_.expand(pair, found.simplex, goal);
  outcome.iterations += depth.iterations;
  if (depth.end == ExpansionEnd::apart && -depth.upper - radius > rounding) {
    outcome.answer = Answer::separated;
    outcome.status = asks_distance(task) ? Status::not_converged : Status::ok;
    if (asks_distance(task)) clear_numbers(outcome);
    return;
  }
  const bool inside =
      proven || depth.lower > rounding || (!goal.doubtful && depth.lower + radius > rounding);
  const bool known = depth.end == ExpansionEnd::converged || depth.end == ExpansionEnd::flat;
  outcome.answer = inside ? Answer::overlapping : Answer::unknown;
  outcome.status = Status::not_converged;
  if (inside && (known || !asks_depth(task))) outcome.status = Status::ok;
  if (!inside && depth.end == ExpansionEnd::flat) outcome.status = Status::degenerate;
  const Scalar lower = -(radius + depth.upper);
  // If the origin may be outside the polytope, its faces give no bound from the other side.
  const Scalar upper = inside ? -(radius + depth.lower) : nearest - radius;
  if (!inside && !write_if_touching(pair, lower, upper, outcome)) clear_numbers(outcome);
  if (!asks_for_number(task, inside ? Answer::overlapping : Answer::unknown)) return;
  write(pair, lower, lower, upper, depth.normal, depth.a, depth.b, outcome);
}

template class GjkQuery<float>;
template class GjkQuery<double>;

}  // namespace touchstone
