// Part of clipped-faces: GJK, followed by EPA if the cores overlap.
#include "algorithms/manifold/clipped_faces/penetration.h"

#include <algorithm>

#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/minkowski/resolution.h"

namespace touchstone {
namespace {

constexpr int most_iterations = 128;  // cap on GJK's iterations

// Writes `touching` if these bounds on the signed distance are within the resolution.
template <class Scalar>
void write_if_touching(Scalar lower, Scalar upper, Penetration<Scalar>& result) {
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  if (!are_at_contact(lower - rounding, upper + rounding,
                      static_cast<Scalar>(resolution<Scalar>))) {
    return;
  }
  result.answer = Answer::touching;
  result.status = Status::ok;
}

// EPA, from a simplex whose distance to the origin is zero up to rounding.
template <class Scalar>
Penetration<Scalar> expand_from(SupportPair<Scalar>& pair, const GjkDistanceResult<Scalar>& found,
                                Scalar tolerance, ExpandingPolytope<Scalar>& polytope) {
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  const bool inside_core = found.nearest.inside && found.nearest.distance > rounding;
  // The simplex bounds the gap from above.
  const Scalar gap = found.nearest.inside ? Scalar{0} : distance_from_origin(found.simplex);
  const bool on_core = !found.nearest.inside && gap <= 4 * rounding;
  const ExpansionGoal<Scalar> goal{
      .tolerance = tolerance, .away = gap, .doubtful = !inside_core && !on_core};
  const Expansion<Scalar> depth = polytope.expand(pair, found.simplex, goal);
  Penetration<Scalar> result;
  if (depth.end == ExpansionEnd::apart && -depth.upper - pair.radius() > rounding) {
    result.answer = Answer::separated;
    result.status = Status::ok;
    return result;
  }
  const bool inside = inside_core || (on_core && pair.radius() > 8 * rounding) ||
                      depth.lower > rounding ||
                      (!goal.doubtful && depth.lower + pair.radius() > rounding);
  const bool known = depth.end == ExpansionEnd::converged || depth.end == ExpansionEnd::flat;
  result.answer = inside ? Answer::overlapping : Answer::unknown;
  if (inside && known) result.status = Status::ok;
  if (!inside) write_if_touching(-depth.upper - pair.radius(), gap - pair.radius(), result);
  result.depth = pair.radius() + depth.upper;
  result.normal = depth.normal;
  result.a = depth.a + pair.radius_a() * depth.normal;
  result.b = depth.b - pair.radius_b() * depth.normal;
  return result;
}

}  // namespace

template <class Scalar>
Penetration<Scalar> find_penetration(SupportPair<Scalar>& pair,
                                     ExpandingPolytope<Scalar>& polytope) {
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  const auto smooth = static_cast<Scalar>(sizeof(Scalar) == 8 ? 0.5e-10 : 0.5e-5);
  const Scalar tolerance = std::max(pair.is_polytope() ? Scalar{0} : smooth, rounding);
  const GjkDistanceGoal<Scalar> goal{
      .task = Task::penetration, .tolerance = tolerance, .most_iterations = most_iterations};
  const GjkDistanceResult<Scalar> found = gjk_distance(pair, goal);
  if (found.end == GjkDistanceResult<Scalar>::End::contact) {
    return expand_from(pair, found, tolerance, polytope);
  }
  Penetration<Scalar> result;
  if (found.lower - pair.radius() > rounding) {
    result.answer = Answer::separated;
    result.status = Status::ok;
    return result;
  }
  if (found.upper - pair.radius() < -rounding) {
    result.answer = Answer::overlapping;
    if (!goal.is_open(pair, found.nearest.distance, found.lower)) result.status = Status::ok;
  }
  if (result.answer == Answer::unknown) {
    write_if_touching(found.lower - pair.radius(), found.upper - pair.radius(), result);
  }
  result.depth = pair.radius() - found.nearest.distance;
  result.normal = -found.nearest.direction;
  const DifferencePoint<Scalar> nearest = weighted_mean(found.simplex);
  result.a = nearest.a + pair.radius_a() * result.normal;
  result.b = nearest.b - pair.radius_b() * result.normal;
  return result;
}

template Penetration<float> find_penetration(SupportPair<float>&, ExpandingPolytope<float>&);
template Penetration<double> find_penetration(SupportPair<double>&, ExpandingPolytope<double>&);

}  // namespace touchstone
