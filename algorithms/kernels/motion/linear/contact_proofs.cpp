// GJK at a fixed time, for the proof that bodies share a point.
#include "algorithms/kernels/motion/linear/contact_proofs.h"

#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/motion/inner_ball.h"

namespace touchstone {
bool contact_is_proven(MovingPair& pair, Simplex<double> simplex, double time, int& iterations) {
  constexpr int most_iterations = 16;
  constexpr double margin = MovingPair::rounding;
  const double radius = pair.radius();
  pair.move_to(time, simplex);
  if (is_in_front_of_ball(weighted_mean(simplex).difference, -pair.offset(), pair.inner_radius(),
                          margin)) {
    return true;
  }
  for (int k = 0; k < most_iterations; ++k) {
    ++iterations;
    const NearestPoint<double> nearest = reduce_to_nearest(simplex);
    // The corners are off by at most corner_rounding, which is_surely_inside allows for.
    if (nearest.inside) return radius > margin || is_surely_inside(simplex);
    if (distance_from_origin(simplex) + margin < radius) return true;
    if (!(nearest.distance > 0)) return false;
    const DifferencePoint<double> point = pair.support(-nearest.direction);
    if (nearest.direction.dot(point.difference) - radius > margin) return false;
    for (int i = 0; i < simplex.size; ++i) {
      const auto known = simplex.points[static_cast<std::size_t>(i)].difference;
      if (known == point.difference) return false;
    }
    simplex.points[static_cast<std::size_t>(simplex.size++)] = point;
  }
  return false;
}

}  // namespace touchstone
