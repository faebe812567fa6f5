// Points in an affine frame of their own, where no set is thin.
#pragma once

#include <vector>

#include "algorithms/core/double_double.h"
#include "algorithms/core/vec.h"

namespace touchstone {

// The points in a frame of their own: affine coordinates along three edges of a tetrahedron that
// spans them, the longest there is, then the widest, then the thickest. Hulls are the same in every
// affine frame, and in this one no set is thin, far off, large or small. Computed in twice the
// precision from exact differences, so that even a sliver's coordinates are good to a double.
struct OwnFrame {
  int dimension = 0;
  std::vector<DoubleDouble3> offsets;  // of the points from one of them, divided by a power of two
  std::vector<Vec3d> points;           // own coordinates; beyond `dimension` they are 0
  double thickness = 1;                // over length
};

// At least one point, all finite.
OwnFrame own_frame(const std::vector<Vec3d>& points);

}  // namespace touchstone
