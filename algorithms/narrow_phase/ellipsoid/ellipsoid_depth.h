// Part of ellipsoid: the depth of two overlapping ellipsoids, or of an ellipsoid and a ball. It is
// the least overlap of all planes, with a proof that no other plane has less. Includes core and
// this folder.
//
// Proof:   for any orthogonal S the sum of the two bodies contains the ellipsoid of E = P + Q S. If
//          S turns P^T n into the direction of Q^T n, that ellipsoid touches the sum along n. Its
//          shortest way out is along n exactly if E E^T - depth |E^T n| has no negative eigenvalue.
//          That test proves the depth at once.
// Steps:   1. Test the plane of the ascent with the inner ellipsoid of greatest size.
//          2. If the test fails, find a cap of normals around the minimum in which the ellipsoid's
//             curvature proves no lower overlap.
//          3. Divide the sphere of normals into eight triangles.
//          4. Bound the overlap in a triangle from below by the support plane at its middle, or by
//             a cap that contains it.
//          5. If a middle has less overlap, ascend from there to a new minimum and test it as in
//             step 1.
//          6. Divide triangles whose bound is below the least overlap, until none is left or the
//             cap is reached.
// Paper:   Kurzhanski, Valyi, "Ellipsoidal Calculus for Estimation and Control", 1997, sec. 2.3
//          (inner ellipsoids of a sum); More, Sorensen, "Computing a trust region step", SIAM J.
//          Scientific and Statistical Computing 4(3), 1983 (the eigenvalue condition).
#pragma once

#include "algorithms/narrow_phase/ellipsoid/ellipsoid_pair.h"

namespace touchstone {

template <class Scalar>
struct EllipsoidDepth {
  EllipsoidPlane<Scalar> plane;  // the plane of least overlap found: the cores' is -plane.gap
  Scalar lower;                  // lower bound on the cores' overlap along any normal
  int iterations = 0;            // Newton steps and caps
};

// `plane` is the result of an ascent. `most_caps` limits the search; with 0 only the test runs.
template <class Scalar>
EllipsoidDepth<Scalar> ellipsoid_depth(const EllipsoidPair<Scalar>& pair,
                                       const EllipsoidPlane<Scalar>& plane, Scalar tolerance,
                                       const ClimbGoal& goal, int most_caps);

}  // namespace touchstone
