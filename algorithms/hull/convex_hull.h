// Convex hulls with their faces, edges and neighbours, computed by Qhull. Used by whatever makes a
// hull shape: scenes, case files, tests.
#pragma once

#include <memory>
#include <vector>

#include "algorithms/core/shape.h"

namespace touchstone {

// Returns the hull of at least one finite point (metres). The points are its vertices, in order and
// literally, extreme or not; repeated and interior points belong to no face, edge or neighbour
// list. A point, a segment and a flat set have dimension 0, 1 and 2 and no faces; a set thinner
// than 2^-48 of its length counts as flat. If Qhull fails on a solid set (slivers), or its result
// does not pass a check, dimension is 3 and the faces are empty; algorithms that need faces then
// report `degenerate`.
std::shared_ptr<const Hull> make_hull(std::vector<Vec3d> points);

// Returns a shape of kind hull with that hull.
Shape hull_of(std::vector<Vec3d> points);

// Like make_hull, but drops the points that are not vertices of the hull, for the reduction of
// meshes. The result is never empty.
std::shared_ptr<const Hull> make_reduced_hull(const std::vector<Vec3d>& points);

}  // namespace touchstone
