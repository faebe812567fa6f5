// Part of ellipsoid: decides whether two ellipsoids, or an ellipsoid and a ball, share a point, by
// a search over one number. Includes core and this folder.
//
// For weights a + b = 1 let n = (a A + b B)^-1 c, with A and B the bodies' matrices and c the
// vector between the centres. The point a A n = c - b B n lies in both bodies scaled by a |n|_A and
// b |n|_B. If neither scale is above 1 it is a common point; if n.c is above |n|_A + |n|_B the
// plane separates. At the best weights one of the two holds: the function a b c.(a A + b B)^-1 c is
// concave in b and greatest where both scales are equal.
// Paper:   Perram, Wertheim, "Statistical mechanics of hard ellipsoids. I. Overlap algorithm and
//          the contact function", J. Computational Physics 58, 1985.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/narrow_phase/ellipsoid/ellipsoid_pair.h"

namespace touchstone {

template <class Scalar>
struct EllipsoidContact {
  Answer answer = Answer::unknown;  // separated or overlapping by more than rounding, or unknown
  Vec3<Scalar> normal;              // unit length; separates the bodies if the answer is separated
  int iterations = 0;
};

template <class Scalar>
EllipsoidContact<Scalar> contact(const EllipsoidPair<Scalar>& pair, int most_iterations);

}  // namespace touchstone
