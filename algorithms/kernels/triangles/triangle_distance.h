// The distance of two triangles that share no point, in doubles, with its nearest points and a bound
// from below.
// Papers: Larsen, Gottschalk, Lin, Manocha, UNC TR99-018, 1999 (nearest pairs of edges, and corners
//         over faces); Ericson, "Real-Time Collision Detection", 2005, 5.1 (nearest points of segments).
#pragma once

#include "algorithms/kernels/triangles/exact_triangles.h"

namespace touchstone {

struct TriangleDistance {
  Vec3d on_a, on_b;  // the nearest points that were found
  double distance;   // theirs
};

// The nearest points are right up to rounding, and what is found is the distance of two points of
// the triangles in any case, so that the triangles are not further apart.
TriangleDistance triangle_distance(const TriangleCorners& a, const TriangleCorners& b);

// The nearest points of a segment and the edges of a triangle, with the same promises; `on_a` is on the segment.
using Segment = std::array<Vec3d, 2>;
TriangleDistance distance_to_edges(const Segment& segment, const TriangleCorners& triangle);

// A distance that the triangles have at least, but for the rounding of its last few sums: the
// greatest gap along the line of the nearest points and the axes on which the distance of triangles
// is one between parallel planes.
double distance_bound(const TriangleCorners& a, const TriangleCorners& b,
                      const TriangleDistance& nearest);

}  // namespace touchstone
