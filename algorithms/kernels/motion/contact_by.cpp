// Proofs of contact by GJK.
#include "algorithms/kernels/motion/contact_by.h"

#include <algorithm>

#include "algorithms/kernels/gjk/gjk_distance.h"

namespace touchstone {

bool contact_is_proven(SupportPair<double>& pair, double slack, int& iterations) {
  constexpr int most_iterations = 64;
  const GjkDistanceGoal<double> goal{.task = Task::intersect,
                                     .tolerance = SupportPair<double>::rounding,
                                     .most_iterations = most_iterations};
  GjkDistanceResult<double> found = gjk_distance(pair, goal);
  iterations += found.iterations;
  if (found.simplex.size == 0) return false;
  const double margin = RelativeMotion::pair_rounding + slack / pair.unit();
  const NearestPoint<double> nearest = reduce_to_nearest(found.simplex);
  // If every corner is off by less than the distance of the faces from the origin, the true
  // tetrahedron contains the origin too: no plane parts them.
  if (nearest.inside) {
    return pair.radius() > margin || (nearest.distance > margin && is_surely_inside(found.simplex));
  }
  return distance_from_origin(found.simplex) + margin < pair.radius();
}

std::optional<double> contact_by(const RelativeMotion& motion, double from, double step,
                                 int& iterations) {
  constexpr int most_tries = 7;
  constexpr double growth = 16;
  for (int k = 0; k < most_tries; ++k, step *= growth) {
    const double time = std::min(from + step, 1.0);
    SupportPair<double> pair = motion.at(time);
    if (contact_is_proven(pair, motion.placement_rounding(), iterations)) return time;
    if (!(time < 1)) break;
  }
  return {};
}

}  // namespace touchstone
