// Part of the oracle: pairs in which at least one body is a half-space.
#pragma once

#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/exact_measure.h"
#include "algorithms/oracle/grid_pair.h"

namespace touchstone::oracle {

// The image of a half-space: points y, relative to the body's translation, with normal . y *
// denominator <= offset * 2^exponent. A singular matrix gives the normal 0.
struct ExactHalfSpace {
  IntegerVector normal;
  Integer offset, denominator;
  long exponent = 0;
};
ExactHalfSpace exact_half_space(const Body& body);
inline bool is_half_space(const Body& body) { return body.solid->core == Solid::Core::halfspace; }

// Sets core_lower, core_upper and normal of the result. At least one of the bodies must be a
// half-space. `pair` is scratch memory.
ExactMeasure measure_half_space(const Body& a, const Body& b, GridPair& pair,
                                const Filters& filters, Certificate* certificate);

}  // namespace touchstone::oracle
