// Convex hulls with their faces, edges and neighbours, computed by Qhull.
#pragma once

#include <memory>
#include <vector>

#include "algorithms/core/shape.h"

namespace touchstone {

// The hull of at least one finite point (metres); the points are kept, in order and literally, as
// its vertices, whether extreme or not (repeated and interior points belong to no face, edge or
// neighbour list). A point, a segment and a flat set give dimension 0, 1, 2 and no faces; what is
// thinner than 2^-48 of its length is rounding, and counts as flat. Where Qhull gives up on a set
// that is solid (slivers), or what it gives does not pass a check, dimension is 3 and the faces are
// empty: algorithms that need them then say `degenerate`.
std::shared_ptr<const Hull> make_hull(std::vector<Vec3d> points);

// The same without the points that are no vertices of the hull: what a mesh is reduced to. Never
// empty.
std::shared_ptr<const Hull> make_reduced_hull(const std::vector<Vec3d>& points);

}  // namespace touchstone
