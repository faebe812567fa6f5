// Used by gjk-ray-cast and mpr-ray-cast: whether bodies that are in contact at the start approach.
#pragma once

#include <algorithm>

#include "algorithms/kernels/epa/expanding_polytope.h"
#include "algorithms/kernels/motion/linear/moving_pair.h"

namespace touchstone {

enum class Approach : std::uint8_t { no, yes, unknown };

// The bodies approach if they get deeper into each other than the tolerance along every direction.
// Seen from b's centre the path is a segment; taken off the difference of the bodies it leaves a convex
// set, whose depth about the origin is the least depth that any fixed direction keeps. GJK finds a plane
// that bodies keep to which are round or only near each other; EPA finds the face that the origin is on or
// behind, and its distance.
class ApproachTest {
 public:
  explicit ApproachTest(int most_iterations)
      : most_iterations_(most_iterations), polytope_(std::min(most_iterations, most_expansions)) {}

  // The tolerance is in the pair's unit. A depth within MovingPair::rounding of it is taken as either.
  Approach ask(MovingPair& pair, double tolerance, int& iterations);

 private:
  static constexpr int most_expansions = 256;

  int most_iterations_;
  ExpandingPolytope<double> polytope_;
};

}  // namespace touchstone
