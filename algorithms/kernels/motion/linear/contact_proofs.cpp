// Of casts without rotation: GJK between the difference of two bodies and the path of their offset, or one
// point of it.
#include "algorithms/kernels/motion/linear/contact_proofs.h"

#include <algorithm>

#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/gjk/simplex_face.h"
#include "algorithms/kernels/motion/inner_ball.h"

namespace touchstone {
namespace {

// Along a unit direction: the lesser of the gaps at time 0 and time 1, and the difference point
// that it is made of.
struct PathPlane {
  double gap;
  DifferencePoint<double> point;
};

PathPlane plane_along(MovingPair& pair, const Vec3d& direction) {
  PathPlane plane{0, pair.support(direction)};
  const double speed = direction.dot(pair.velocity());
  const Vec3d about = plane.point.a - plane.point.b;
  plane.gap = direction.dot(pair.start() - about) + std::min(speed, 0.0) - pair.radius();
  plane.point.difference = about - pair.start();
  if (speed < 0) plane.point.difference -= pair.velocity();
  return plane;
}

}  // namespace

bool never_deeper(MovingPair& pair, double tolerance, int most_iterations, int& iterations) {
  const double least = MovingPair::rounding - tolerance;
  const double length = pair.start().norm();
  Vec3d direction = length > 0 ? Vec3d(pair.start() / length) : Vec3d::UnitX();
  Simplex<double> simplex;
  for (int k = 0; k < most_iterations; ++k) {
    ++iterations;
    const PathPlane plane = plane_along(pair, direction);
    if (plane.gap >= least) return true;
    for (int i = 0; i < simplex.size; ++i) {
      const auto known = simplex.points[static_cast<std::size_t>(i)].difference;
      if (known == plane.point.difference) return false;
    }
    simplex.points[static_cast<std::size_t>(simplex.size++)] = plane.point;
    const NearestPoint<double> nearest = reduce_to_nearest(simplex);
    if (nearest.inside) {
      // The path may lie in a face, which rounding has moved inward.
      const auto face = nearest_face(simplex, Vec3d(-pair.start()));
      return face && plane_along(pair, -face->normal).gap >= least;
    }
    if (!(nearest.distance > 0) || nearest.direction.isZero(0)) return false;
    direction = -nearest.direction;
  }
  return false;
}

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
