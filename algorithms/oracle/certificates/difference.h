// Part of the oracle, used by the checks of certificates: the difference A - B of two cores in rationals.
#pragma once

#include <vector>

#include "algorithms/oracle/certificates/rational_core.h"

namespace touchstone::oracle {

// The gap between the cores' shadows along a direction, as a length; minus infinity where no bound on a shadow is
// known. That proves a lower bound alone: cores without a known bound need not meet.
SignedSquare gap_along(const RationalVector& n, const RationalCore& a, const RationalCore& b);

// The signed distance of two half-spaces, which is minus infinity unless they face each other. Throws Fault if the
// matrix of one is singular.
SignedSquare distance_of_halfspaces(const RationalCore& a, const RationalCore& b);

// Points of the difference, by their generators.
class Difference {
 public:
  Difference(std::vector<RationalVector> a, std::vector<RationalVector> b)
      : a_(std::move(a)), b_(std::move(b)) {}

  RationalVector operator()(const DifferencePoint& point) const;
  // The mean by weights.
  RationalVector operator()(const std::vector<Certificate::Term>& terms) const;

 private:
  std::vector<RationalVector> a_, b_;
};

// Minus the least distance of the triangles' planes from the origin. Every edge has its reverse, so the
// surface winds around the origin a whole number of times, and at least once, since all triangles wind in
// one direction. So each ray from the origin meets the surface, no nearer than the nearest plane.
SignedSquare surface_depth(const Certificate::Surface& surface, const Difference& difference);

// How far from 0 the mean of points of the difference is. With a half-space, how high the other body's is over
// its plane.
SignedSquare distance_of(const std::vector<Certificate::Term>& terms, const Difference& difference,
                         const RationalCore& a, const RationalCore& b);

}  // namespace touchstone::oracle
