// The reference for algorithms that use support functions: signed distances and normals of bodies
// whose cores are polytopes, from their vertices alone, in long double. Takes points, segments and
// flat bodies as well, and hulls that came without faces; the time grows with the fifth power of
// the vertices, so these are few. brute_force.h is for boxes and hulls with their faces and edges,
// and much faster.
#pragma once

#include "algorithms/narrow_phase.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::reference {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;

struct Body {
  Shape shape;
  Pose pose;
};

// The gap between two bodies whose cores are polytopes with a few vertices, or minus their depth:
// boxes, hulls, spheres and capsules, at the poses as they stand. By definition: apart, the least
// distance of all vertices, segments and triangles between vertices of one and of the other;
// otherwise, the least height of the Minkowski difference over all normals that its faces can have.
// `normal` becomes the direction from a to b.
Real signed_distance(const Body& a, const Body& b, Vec3d& normal);
// The greatest of the bodies' extents from their centres, and of the distance between those.
double pair_size(const Body& a, const Body& b);
// The distance of a point from the body; 0 inside. Any kind but hull.
double outside_by(const Body& body, const Vec3d& point);

// One query. Swaps the bodies for the call where their kinds are in the wrong order, and turns the
// outcome around again.
Outcome query(NarrowPhase& algorithm, Task task, const Body& a, const Body& b);

}  // namespace touchstone::reference
