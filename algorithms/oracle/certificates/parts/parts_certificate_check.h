// Part of the oracle: the independent check of a certificate of two bodies of many parts.
#pragma once

#include <string>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/oracle/certificates/parts/parts_certificate.h"

namespace touchstone::oracle {

struct PlacedBody {
  const ConcaveBody& body;
  Pose pose;
};

// Returns why the certificate does not prove its claim, or an empty string if it does.
std::string fault(const PartsCertificate& certificate, const PlacedBody& a, const PlacedBody& b);

}  // namespace touchstone::oracle
