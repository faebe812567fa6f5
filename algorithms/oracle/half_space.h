// Half-spaces against everything.
#pragma once

#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/grid_pair.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

// The image of a half-space: the points y, relative to the body's translation, with
// normal . y * denominator <= offset * 2^exponent. A matrix without an inverse gives the normal 0.
struct ExactHalfSpace {
  IntegerVector normal;
  Integer offset, denominator;
  long exponent = 0;
};
ExactHalfSpace exact_half_space(const Body& body);

// At least one of the bodies is a half-space; core_lower, core_upper and normal are set. The pair
// is memory to work in.
Measure measure_half_space(const Body& a, const Body& b, GridPair& pair, const Filters& filters,
                           Certificate* certificate);

}  // namespace touchstone::oracle
