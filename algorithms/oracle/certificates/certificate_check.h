// Verifies certificates, in rationals and without any of the oracle's own arithmetic.
#pragma once

#include <string>

#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// Why the certificate does not prove its answer and its bounds for these bodies; empty where it
// does.
std::string fault(const Certificate& certificate, const Body& a, const Body& b);

}  // namespace touchstone::oracle
