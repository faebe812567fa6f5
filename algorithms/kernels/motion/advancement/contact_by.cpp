// Proofs of contact by points that the bodies carry with them, GJK, or the closest points of round bodies.
#include "algorithms/kernels/motion/advancement/contact_by.h"

#include <algorithm>

#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/motion/advancement/round_cores.h"
#include "algorithms/kernels/motion/length.h"

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

// The points that were nearest to each other at some time, as the bodies carry them.
struct CarriedPoints {
  CarriedPoints(const RelativeMotion& motion, const NearestPoints& nearest, double time)
      : offset(motion.offset(time)) {
    // The acceleration of a point that turns has a constant length.
    const double later = time - nearest.time;
    const Vec3d speed_a = motion.a().motion->rotation_vector.cross(nearest.a);
    const Vec3d speed_b = motion.b().motion->rotation_vector.cross(nearest.b);
    a = nearest.a + later * speed_a;
    b = nearest.b + later * speed_b;
    const double bend =
        0.5 * later * later *
        (motion.angle_a() * length_of(speed_a) + motion.angle_b() * length_of(speed_b));
    const double lengths = length_of(a) + length_of(b) + length_of(offset);
    doubt = 2 * (RelativeMotion::pair_rounding * lengths + motion.placement_rounding() + bend);
  }

  Vec3d a, b,
      offset;    // the points from their bodies' origins, and from the first of these to the second
  double doubt;  // how far the difference of the points is off
};

// Returns true if a point (from the body's origin) is in a box, even if it is off by `doubt`.
bool is_surely_in_box(const MovingBody& body, const PosedShape<double>& shape, double unit,
                      const Vec3d& point, double doubt) {
  if (shape.shape().core != SupportCore::box || !shape.shape().is_centred) return false;
  const Mat3d rotation = unit / shape.shape().unit * shape.matrix();
  const Vec3d seen = rotation.transpose() * point;
  // Coordinates are off by as much as the matrix is off a rotation, which its start is too.
  const double skew = 1 - body.stretch.least;
  const double margin = doubt + 2 * skew * length_of(seen);
  return skew < 0.5 &&
         ((shape.shape().unit * shape.shape().extents - seen.cwiseAbs()).array() > margin).all();
}

// Returns true if the points prove contact with the balls around the cores, or with those inside of them.
bool is_proven_by_balls(const RelativeMotion& motion, const CarriedPoints& at, double time) {
  const Vec3d apart = at.a - at.b - at.offset;
  if (length_of(apart) + at.doubt < motion.a().shape->radius + motion.b().shape->radius)
    return true;
  const double inner = motion.a().inner_radius() + motion.b().inner_radius();
  return inner > 0 &&
         is_in_front_of_ball(apart, motion.centre_a(time) - motion.centre_b(time) - at.offset,
                             inner, at.doubt);
}

}  // namespace

std::optional<double> contact_by(const RelativeMotion& motion, const NearestPoints& nearest,
                                 double step, int& iterations) {
  constexpr int most_tries = 7;
  constexpr double growth = 16;
  for (int k = 0; k < most_tries; ++k, step *= growth) {
    const double time = std::min(nearest.time + step, 1.0);
    const CarriedPoints at(motion, nearest, time);
    if (is_proven_by_balls(motion, at, time)) return time;
    SupportPair<double> pair = motion.at(time);
    if (is_surely_in_box(motion.a(), pair.a(), pair.unit(), at.b + at.offset, at.doubt) ||
        is_surely_in_box(motion.b(), pair.b(), pair.unit(), at.a - at.offset, at.doubt)) {
      return time;
    }
    if (contact_is_proven(pair, motion.placement_rounding(), iterations)) return time;
    if (!(time < 1)) break;
  }
  return {};
}

}  // namespace touchstone
