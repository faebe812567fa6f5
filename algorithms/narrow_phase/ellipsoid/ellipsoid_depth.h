// The depth of two overlapping ellipsoids, or of an ellipsoid and a ball: the least of all planes'
// overlaps, with a proof that no other plane has less.
//
// For any orthogonal S the sum of the two bodies has the ellipsoid of E = P + Q S inside; where S
// turns P^T n into the direction of Q^T n it touches the sum along n. The way out of a single
// ellipsoid is the shortest one of all exactly where E E^T - depth |E^T n| has no negative
// eigenvalue. So that test proves the depth at once; where it fails the sphere of normals is
// searched by branch and bound: a support point bounds the overlap over a cap around its normal
// from below, and around a minimum E does by its curvature.
// Paper: Kurzhanski, Valyi, "Ellipsoidal Calculus for Estimation and Control", 1997, sec. 2.3
// (inner ellipsoids of a sum); More, Sorensen, "Computing a trust region step", SIAM J. Scientific
// and Statistical Computing 4(3), 1983 (the eigenvalue condition).
#pragma once

#include "algorithms/narrow_phase/ellipsoid/ellipsoid_pair.h"

namespace touchstone {

template <class Scalar>
struct EllipsoidDepth {
  EllipsoidPlane<Scalar> plane;  // of the least overlap found: the cores' is -plane.gap
  Scalar lower;                  // the cores' overlap along any normal is no less
  int iterations = 0;            // Newton steps and caps
};

// `plane` is one that the climb came to. `most_caps` of the search; none: the test alone.
template <class Scalar>
EllipsoidDepth<Scalar> ellipsoid_depth(const EllipsoidPair<Scalar>& pair,
                                       const EllipsoidPlane<Scalar>& plane, Scalar tolerance,
                                       const ClimbGoal& goal, int most_caps);

}  // namespace touchstone
