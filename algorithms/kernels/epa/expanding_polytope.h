// EPA: a polytope inside the difference of two bodies grows at the face nearest to the origin. Used
// by gjk, gjk-templated and gjk-lanes (through gjk_query), by clipped-faces, and by gjk-ray-cast and
// mpr-ray-cast for bodies that are in contact at the start.
//
// The polytope's vertices are points of the difference, so the origin's distance from the nearest
// face is a lower bound on the depth. A support point along any unit vector gives an upper bound.
// The search ends when the bounds meet.
// Paper:   van den Bergen, "Proximity queries and penetration depth computation on 3D game
//          objects", GDC 2001.
// Steps:   1. Grow the given simplex to a tetrahedron with support points away from it
//             (`grow_to_tetrahedron`). If there are none, the difference is flat and the depth is
//             zero.
//          2. Choose the face nearest to the origin; its distance raises the lower bound
//             (epa_hull).
//          3. Find the support point along its normal; its height is an upper bound, and the least
//             one is the answer.
//          4. If the height is negative, a plane separates the bodies: stop.
//          5. If the bounds meet to the tolerance, or both lie on one side of goal.enough, stop.
//          6. Otherwise add the point to the hull. If rounding prevents that, set the face aside;
//             it limits the lower bound from then on. Repeat from step 2.
//          7. If the origin may be outside (goal.doubtful), check it against every face
//             (`encloses_origin`).
//          8. Project the origin on the face of the answer; its weights give the witness points
//             (origin_projection).
// Departs: both bounds are kept, and the answer is the upper one, because that translation does
//          separate. The first tetrahedron may have the origin on its surface, or as far outside
//          as the simplex is from it (goal.away). The lower bound is then negative, until every
//          face is further from the origin than the simplex: an origin outside would be as near to
//          a face.
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/epa/epa_hull.h"
#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// Termination criteria for the depth of the cores; lengths in the pair's unit.
template <class Scalar>
struct ExpansionGoal {
  Scalar tolerance;  // stop when the bounds are this close
  // Stops when the lower bound exceeds `enough` or the upper bound does not: for queries that need
  // only a verdict. Negative: continue to the tolerance.
  Scalar enough = -1;
  // The simplex's distance from the origin, which may be that far outside; a few roundings at most.
  // It is not used if the goal is doubtful.
  Scalar away = 0;
  // The origin may lie outside. Then a separating plane ends the search, and a positive depth is
  // claimed only after all faces are checked.
  bool doubtful = false;
};

enum class ExpansionEnd : std::uint8_t {
  converged,  // the bounds are within the tolerance
  enough,     // both bounds are on one side of goal.enough
  apart,      // a plane separates the origin from the difference: `upper` is negative
  flat,       // the difference has no volume: the depth is zero
  stuck,      // rounding lets no face be expanded
  cap,        // too many iterations
};

template <class Scalar>
struct Expansion {
  ExpansionEnd end = ExpansionEnd::stuck;
  Scalar lower = 0;  // bounds on the depth: the least distance from the origin to the
  Scalar upper = 0;  // difference's surface, negative from outside
  Vec3<Scalar> normal = Vec3<Scalar>::UnitX();  // outward, at the upper bound
  Vec3<Scalar> a = Vec3<Scalar>::Zero();        // the points of the cores with
  Vec3<Scalar> b = Vec3<Scalar>::Zero();        // a - b = depth * normal
  int iterations = 0;
  bool has_surface = false;  // surface() is that of this call
};

template <class Scalar>
class ExpandingPolytope {
 public:
  // `max_iterations` >= 1. The constructor allocates memory for that many; a query allocates none.
  explicit ExpandingPolytope(int max_iterations);

  // The simplex may have any size and contains the origin, possibly on its boundary up to rounding.
  // A pair is a SupportPair, or another with its `support`: see expanding_polytope.inl.
  template <class Pair>
  Expansion<Scalar> expand(Pair& pair, const Simplex<Scalar>& simplex,
                           const ExpansionGoal<Scalar>& goal);

  // The closed surface that the last call left, if its result says that it has one.
  const EpaHull<Scalar>& surface() const { return surface_; }

 private:
  template <class Pair>
  bool grow_to_tetrahedron(Pair& pair, Simplex<Scalar>& simplex, Expansion<Scalar>& result);
  bool encloses_origin() const;
  void find_witnesses(const std::array<int, 3>& best, Expansion<Scalar>& result) const;

  int max_iterations_;
  EpaHull<Scalar> surface_;
};

extern template Expansion<float> ExpandingPolytope<float>::expand(SupportPair<float>&,
                                                                  const Simplex<float>&,
                                                                  const ExpansionGoal<float>&);
extern template Expansion<double> ExpandingPolytope<double>::expand(SupportPair<double>&,
                                                                    const Simplex<double>&,
                                                                    const ExpansionGoal<double>&);

}  // namespace touchstone
