// Part of exact concave: a proven bound on the distance of two triangles, in doubles, so that few
// pairs need integers.
#pragma once

#include <array>

#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// A triangle in its place, in doubles (metres, world).
struct RoundedTriangle {
  std::array<Vec3d, 3> corners;
  double error;  // by how much any coordinate is off at most
};

// The body is one of three vertices.
RoundedTriangle rounded_triangle(const Body& body);

// At most the distance of the triangles, whatever rounding did: how far they are apart along the
// direction, which may be any (and is worth nothing if it is a bad one). 0 if that is not known.
double gap_along(const Vec3d& direction, const RoundedTriangle& a, const RoundedTriangle& b);

// At most the distance of the triangles, and that up to rounding if they are apart: the greatest gap along
// the directions on which two triangles can be nearest. Ends with the first that is above `enough`.
double proven_distance(const RoundedTriangle& a, const RoundedTriangle& b, double enough);

}  // namespace touchstone::oracle
