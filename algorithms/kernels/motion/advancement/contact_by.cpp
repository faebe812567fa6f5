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

// Returns true if the two points, which the bodies carry with them, prove contact with the balls around the cores, or
// with those inside of them.
bool carried_points_prove(const RelativeMotion& motion, const NearestPoints& nearest, double time) {
  const MovingBody &body_a = motion.a(), &body_b = motion.b();
  const Vec3d &turn_a = body_a.motion->rotation_vector, &turn_b = body_b.motion->rotation_vector;
  // The acceleration of a point that turns has a constant length.
  const double later = time - nearest.time;
  const Vec3d speed_a = turn_a.cross(nearest.a), speed_b = turn_b.cross(nearest.b);
  const double bend =
      0.5 * later * later * (motion.angle_a() * speed_a.norm() + motion.angle_b() * speed_b.norm());
  const Vec3d a = nearest.a + later * speed_a, b = nearest.b + later * speed_b;
  const Vec3d offset = motion.offset(time), apart = a - b - offset;
  const double lengths = a.norm() + b.norm() + offset.norm();
  const double doubt =
      2 * (RelativeMotion::pair_rounding * lengths + motion.placement_rounding() + bend);
  if (apart.norm() + doubt < body_a.shape->radius + body_b.shape->radius) return true;
  const double inner = body_a.inner_radius() + body_b.inner_radius();
  return inner > 0 &&
         is_in_front_of_ball(apart, motion.centre_a(time) - motion.centre_b(time) - offset, inner,
                             doubt);
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
