// EPA: grow a polytope inside the difference of two bodies, at the face nearest to the origin.
//
// The polytope's vertices are points of the difference, so the origin's distance from its nearest
// face is a lower bound on the depth; a support call along any unit vector gives an upper bound. It
// ends where they meet.
// Paper:   van den Bergen, "Proximity queries and penetration depth computation on 3D game
// objects", GDC 2001. Departs: both bounds are kept, and the upper one is the answer: that
// translation does separate. A face that cannot be expanded is set aside and holds the lower bound
// down. The start is a tetrahedron that may have the origin on its surface. The surface is kept by
// polytope_surface.h.
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/epa/epa_hull.h"
#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// Where to stop, for the depth of the cores; lengths in the pair's unit.
template <class Scalar>
struct ExpansionGoal {
  Scalar tolerance;  // the bounds are this close
  // The lower bound exceeds `enough`, or the upper bound is no greater: for queries that only ask
  // for a verdict. Negative: go on to the tolerance.
  Scalar enough = -1;
  // The origin may prove to be outside: then a plane between is looked for, and a positive depth is
  // only claimed after all faces were checked.
  bool doubtful = false;
};

enum class ExpansionEnd : std::uint8_t {
  converged,  // the bounds are within the tolerance
  enough,     // they are on one side of goal.enough
  apart,      // a plane separates the origin from the difference: `upper` is negative
  flat,       // the difference has no volume: the depth is zero
  stuck,      // rounding: no face can be expanded
  cap,        // too many iterations
};

template <class Scalar>
struct Expansion {
  ExpansionEnd end = ExpansionEnd::stuck;
  Scalar lower = 0;  // bounds on the depth: the least distance from the origin to the
  Scalar upper = 0;  // difference's surface
  Vec3<Scalar> normal = Vec3<Scalar>::UnitX();  // outward, at the upper bound
  Vec3<Scalar> a = Vec3<Scalar>::Zero();        // the points of the cores with
  Vec3<Scalar> b = Vec3<Scalar>::Zero();        // a - b = depth * normal
  int iterations = 0;
};

template <class Scalar>
class ExpandingPolytope {
 public:
  // `max_iterations` >= 1; memory for that many is taken here, and none in a query.
  explicit ExpandingPolytope(int max_iterations);

  // The simplex has the origin inside or, up to rounding, on it; it may have any size.
  Expansion<Scalar> expand(SupportPair<Scalar>& pair, const Simplex<Scalar>& simplex,
                           const ExpansionGoal<Scalar>& goal);

 private:
  bool grow_to_tetrahedron(SupportPair<Scalar>& pair, Simplex<Scalar>& simplex,
                           Expansion<Scalar>& result);
  bool encloses_origin() const;
  void find_witnesses(const std::array<int, 3>& best, Expansion<Scalar>& result) const;

  int max_iterations_;
  EpaHull<Scalar> surface_;
};

}  // namespace touchstone
