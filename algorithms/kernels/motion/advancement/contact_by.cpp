// Proofs of contact by GJK, or the closest points of round bodies.
#include "algorithms/kernels/motion/advancement/contact_by.h"

#include <algorithm>

#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/motion/advancement/round_cores.h"

namespace touchstone {

bool contact_is_proven(SupportPair<double>& pair, double slack, int& iterations) {
  constexpr int most_iterations = 64;
  const double margin = RelativeMotion::pair_rounding + slack / pair.unit();
  if (is_round(pair)) return closest_of_round(pair).between.norm() + margin < pair.radius();
  const GjkDistanceGoal<double> goal{.task = Task::intersect,
                                     .tolerance = SupportPair<double>::rounding,
                                     .most_iterations = most_iterations};
  GjkDistanceResult<double> found = gjk_distance(pair, goal);
  iterations += found.iterations;
  if (found.simplex.size == 0) return false;
  const NearestPoint<double> nearest = reduce_to_nearest(found.simplex);
  // If every corner is off by less than the distance of the faces from the origin, the true
  // tetrahedron contains the origin too: no plane parts them.
  if (nearest.inside) {
    return pair.radius() > margin || (nearest.distance > margin && is_surely_inside(found.simplex));
  }
  return distance_from_origin(found.simplex) + margin < pair.radius();
}

namespace {

// Returns true if the two points, which the bodies carry with them, prove contact with the balls inside of
// the cores.
bool carried_points_prove(const RelativeMotion& motion, const NearestPoints& nearest, double time) {
  const double inner = motion.a().inner_radius() + motion.b().inner_radius();
  if (!(inner > 0)) return false;
  const double later = time - nearest.time;
  const Vec3d a = rotation_by(later * motion.a().motion->rotation_vector) * nearest.a;
  const Vec3d b = rotation_by(later * motion.b().motion->rotation_vector) * nearest.b;
  const Vec3d offset = motion.offset(time);
  const double lengths = a.norm() + b.norm() + offset.norm();
  const double rounding =
      2 * (RelativeMotion::pair_rounding * lengths + motion.placement_rounding());
  return is_in_front_of_ball(a - b - offset, motion.centre_a(time) - motion.centre_b(time) - offset,
                             inner, rounding);
}

}  // namespace

std::optional<double> contact_by(const RelativeMotion& motion, const NearestPoints& nearest,
                                 double step, int& iterations) {
  constexpr int most_tries = 7;
  constexpr double growth = 16;
  for (int k = 0; k < most_tries; ++k, step *= growth) {
    const double time = std::min(nearest.time + step, 1.0);
    if (carried_points_prove(motion, nearest, time)) return time;
    SupportPair<double> pair = motion.at(time);
    if (contact_is_proven(pair, motion.placement_rounding(), iterations)) return time;
    if (!(time < 1)) break;
  }
  return {};
}

}  // namespace touchstone
