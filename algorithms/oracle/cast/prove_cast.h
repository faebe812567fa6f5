// Part of the oracle: certificates of casts.
#pragma once

#include "algorithms/oracle/cast/enclosure.h"
#include "algorithms/oracle/certificates/cast_certificate.h"

namespace touchstone::oracle {

// Writes the answer of the cast `exact` with its proof. Of polytopes, and balls around them, that do not
// turn, the bracket is 2^-80 wide or the exact time: a fraction, or the root of a quadratic. Only where
// another feature is hit within those 2^-80 it stays a bracket. That of other bodies is as wide as
// `tolerance` (metres) asks, down to what doubles can place.
void prove_cast(Oracle& oracle, const EnclosedBody& a, const EnclosedBody& b, double tolerance,
                CastCertificate& certificate);

// As wide as `exact` makes it.
double default_tolerance(const EnclosedBody& a, const EnclosedBody& b);

}  // namespace touchstone::oracle
