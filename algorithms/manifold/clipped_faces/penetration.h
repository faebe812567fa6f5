// How deep two bounded bodies are in each other: GJK, and EPA where their cores meet.
// Papers: as gjk_approach.h and expanding_polytope.h say.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/epa/expanding_polytope.h"
#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// In the pair's frame and unit. Only answer and status are set where the bodies are apart.
template <class Scalar>
struct Penetration {
  Answer answer = Answer::unknown;
  Status status = Status::not_converged;
  Scalar depth = 0;  // negative, and then below rounding, where they may be apart
  Vec3<Scalar> normal = Vec3<Scalar>::UnitX();  // unit, from a to b
  Vec3<Scalar> a, b;                            // points of the bodies, a - b = depth * normal
};

// Exact up to rounding for polytopes; for curved bodies good to 1e-10 of the size in double and
// 1e-5 in float.
template <class Scalar>
Penetration<Scalar> find_penetration(SupportPair<Scalar>& pair,
                                     ExpandingPolytope<Scalar>& polytope);

extern template Penetration<float> find_penetration(SupportPair<float>&, ExpandingPolytope<float>&);
extern template Penetration<double> find_penetration(SupportPair<double>&,
                                                     ExpandingPolytope<double>&);

}  // namespace touchstone
