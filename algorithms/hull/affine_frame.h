// Part of algorithms/hull, used by convex_hull.cpp alone: points in an affine frame
// in which no set is thin.
#pragma once

#include <vector>

#include "algorithms/core/double_double.h"
#include "algorithms/core/vec.h"

namespace touchstone {

// A frame for the points: affine coordinates along three edges of a tetrahedron that spans them
// (the longest edge, then the widest triangle, then the thickest tetrahedron). A hull's faces are
// the same in every affine frame, and in this one no set is thin, distant, large or small. The
// coordinates are computed in double-double precision from exact differences, so that even a
// sliver's are accurate to a double.
struct OwnFrame {
  int dimension = 0;
  std::vector<DoubleDouble3> offsets;  // from one of the points, divided by a power of two
  std::vector<Vec3d> points;           // affine coordinates; 0 beyond `dimension`
  double thickness = 1;                // the least thickness over length
};

// Requires at least one point; all must be finite.
OwnFrame own_frame(const std::vector<Vec3d>& points);

}  // namespace touchstone
