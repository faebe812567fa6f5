// Bounds on what rounding does in the oracle's floating-point filters.
#pragma once

namespace touchstone::oracle {

// A filter decides in doubles where its bound allows, and leaves the rest to integers. Each bound
// is multiplied by the number here: 1 except in the tests that prove that a broken filter is
// noticed.
struct Filters {
  double plane = 1;        // a direction separates the cores
  double tetrahedron = 1;  // the origin is inside four points of the difference
  double radius = 1;       // the cores' distance against the radii
  double support = 1;      // which vertices may be furthest along a direction
  double visibility = 1;   // a point is beyond a face of a growing polytope
  double nearest = 1;      // which faces may be nearest to the origin
};

}  // namespace touchstone::oracle
