// Part of the oracle: verifies certificates of casts in rationals, without any of the arithmetic that makes
// them. Rotations are enclosed by their power series.
#pragma once

#include <string>

#include "algorithms/oracle/certificates/cast_certificate.h"

namespace touchstone::oracle {

// Returns the reason why the certificate does not prove its claim for these bodies, or an empty string
// if it does. A half-space that turns is refused.
std::string fault(const CastCertificate& certificate, const MovingBody& a, const MovingBody& b);

}  // namespace touchstone::oracle
