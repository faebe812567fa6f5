// Part of the oracle, used by linear_search and prove_cast: two polytopes that move, on one grid of integers.
#pragma once

#include <vector>

#include "algorithms/core/motion.h"
#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/numbers/integer.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// Times are integers from 0 to 2^time_bits. All coordinates are integers in one unit of length, in
// which a step of time moves body b by `velocity` relative to body a.
class MovingCores {
 public:
  static constexpr int time_bits = 80;

  // Both cores are polytopes, and neither body turns.
  MovingCores(const Body& a, const Motion& motion_a, const Body& b, const Motion& motion_b);

  // A point a - b of the difference at time 0, and of which points it is made.
  struct Point {
    IntegerVector difference;
    DifferencePoint of;
  };
  // The point that is least along n. Ties go to the first.
  Point least(const IntegerVector& n) const;
  IntegerVector difference(const DifferencePoint& of) const { return a_[of.a] - b_[of.b]; }
  const IntegerVector& velocity() const { return velocity_; }
  const Integer& radius() const { return radius_; }  // of both balls together

 private:
  std::vector<IntegerVector> a_, b_;  // world coordinates; b's at time 0
  IntegerVector velocity_;
  Integer radius_;
};

}  // namespace touchstone::oracle
