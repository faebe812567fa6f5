// Part of clipped-faces: the penetration of two bounded bodies, by GJK, and by EPA when their cores
// overlap. Papers: see kernels/gjk/gjk_distance.h and kernels/epa/expanding_polytope.h.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/epa/expanding_polytope.h"
#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// All lengths are in the pair's frame and unit. Separated bodies set only answer and status.
template <class Scalar>
struct Penetration {
  Answer answer = Answer::unknown;
  Status status = Status::not_converged;
  Scalar depth = 0;  // negative only if the answer is touching or unknown, and then below rounding
  Vec3<Scalar> normal = Vec3<Scalar>::UnitX();  // unit, from a to b
  Vec3<Scalar> a, b;                            // points on the bodies, a - b = depth * normal
};

// Exact up to rounding for polytopes; accurate to 1e-10 of the size in double and 1e-5 in float for
// curved bodies.
template <class Scalar>
Penetration<Scalar> find_penetration(SupportPair<Scalar>& pair,
                                     ExpandingPolytope<Scalar>& polytope);

extern template Penetration<float> find_penetration(SupportPair<float>&, ExpandingPolytope<float>&);
extern template Penetration<double> find_penetration(SupportPair<double>&,
                                                     ExpandingPolytope<double>&);

}  // namespace touchstone
