// GJK and EPA on the difference of two bodies, less the path of their offset.
#include "algorithms/kernels/motion/linear/approach.h"

#include "algorithms/kernels/epa/expanding_polytope.inl"

namespace touchstone {
namespace {

// The difference of the cores, less the segment from 0 to the displacement.
class SweptDifference {
 public:
  explicit SweptDifference(MovingPair& pair) : pair_(pair) {}

  DifferencePoint<double> support(const Vec3d& direction) {
    DifferencePoint<double> point = pair_.support(direction);
    point.difference = point.a - point.b - pair_.start();
    if (direction.dot(pair_.velocity()) < 0) point.difference -= pair_.velocity();
    return point;
  }

  // How deep the bodies get along a unit vector from a to b; less than 0 if they stay apart.
  double depth_along(const Vec3d& direction) {
    const DifferencePoint<double> point = pair_.support(direction);
    const double speed = direction.dot(pair_.velocity());
    return direction.dot(point.a - point.b - pair_.start()) - std::min(speed, 0.0) + pair_.radius();
  }

 private:
  MovingPair& pair_;
};

// GJK, with what it proves of the depth.
struct SweptSearch {
  Approach verdict = Approach::unknown;
  Simplex<double> simplex;
  NearestPoint<double> nearest;
};

SweptSearch search(SweptDifference& swept, const MovingPair& pair, double enough,
                   int most_iterations, int& iterations) {
  SweptSearch found;
  const double length = pair.start().norm();
  Vec3d direction = length > 0 ? Vec3d(pair.start() / length) : Vec3d::UnitX();
  for (int k = 0; k < most_iterations; ++k) {
    ++iterations;
    if (swept.depth_along(direction) <= enough) {
      found.verdict = Approach::no;
      return found;
    }
    const DifferencePoint<double> point = swept.support(direction);
    for (int i = 0; i < found.simplex.size; ++i) {
      const auto known = found.simplex.points[static_cast<std::size_t>(i)].difference;
      if (known == point.difference) return found;
    }
    found.simplex.points[static_cast<std::size_t>(found.simplex.size++)] = point;
    found.nearest = reduce_to_nearest(found.simplex);
    const double distance = found.nearest.inside ? 0 : found.nearest.distance;
    // Points of both cores are this near at some time, and so are balls of the radius that deep.
    if (pair.radius() - distance > enough) {
      found.verdict = Approach::yes;
      return found;
    }
    if (found.nearest.inside || !(distance > 0) || found.nearest.direction.isZero(0)) return found;
    direction = -found.nearest.direction;
  }
  return found;
}

}  // namespace

Approach ApproachTest::ask(MovingPair& pair, double tolerance, int& iterations) {
  constexpr double rounding = MovingPair::rounding;
  SweptDifference swept(pair);
  const double enough = tolerance - rounding;
  const SweptSearch found = search(swept, pair, enough, most_iterations_, iterations);
  if (found.verdict != Approach::unknown) return found.verdict;
  if (!found.nearest.inside && found.nearest.distance > rounding) return Approach::unknown;
  // The radius is no more than `enough`.
  const Expansion<double> grown = polytope_.expand(
      swept, found.simplex,
      {.tolerance = rounding / 8, .enough = enough - pair.radius(), .doubtful = true});
  iterations += grown.iterations;
  if (swept.depth_along(grown.normal) <= enough) return Approach::no;
  return pair.radius() + grown.lower > enough ? Approach::yes : Approach::unknown;
}

}  // namespace touchstone
