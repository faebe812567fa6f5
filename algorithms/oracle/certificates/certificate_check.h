// Part of the oracle: verifies certificates in rationals, without any of the oracle's own
// arithmetic.
#pragma once

#include <string>

#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// Returns the reason why the certificate does not prove its answer and bounds for these bodies, or
// an empty string if it does.
std::string fault(const Certificate& certificate, const Body& a, const Body& b);

}  // namespace touchstone::oracle
