// Part of the oracle: factors on the error bounds of its floating-point filters, for tests.
#pragma once

namespace touchstone::oracle {

// A filter decides in doubles if its error bound permits, and otherwise leaves the decision to
// integers. Each bound is multiplied by the factor here. The factors are 1 except in tests, which
// prove that a broken filter is noticed.
struct Filters {
  double plane = 1;        // a direction separates the cores
  double tetrahedron = 1;  // the origin is inside four points of the difference
  double radius = 1;       // the cores' distance against the radii
  double support = 1;      // which vertices may be furthest along a direction
  double visibility = 1;   // a point is beyond a face of a growing polytope
  double nearest = 1;      // which faces may be nearest to the origin
};

}  // namespace touchstone::oracle
