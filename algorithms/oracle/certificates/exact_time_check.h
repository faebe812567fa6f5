// Part of the oracle, used by cast_certificate_check alone: the time of impact as the root of a quadratic.
#pragma once

#include <vector>

#include "algorithms/oracle/certificates/cast_certificate.h"
#include "algorithms/oracle/certificates/difference.h"

namespace touchstone::oracle {

// Two polytopes at time 0, of which b moves by `velocity` relative to a, and the sum of their radii.
struct RationalMotion {
  std::vector<RationalVector> a, b;
  RationalVector velocity;
  mpq_class radius;
  mpq_class lower, upper;  // times
};

// Throws Fault unless the feature proves that the bodies touch at the root of the polynomial, and not before.
void require_exact_time(const CastCertificate& certificate, const RationalMotion& motion,
                        const Difference& difference);

}  // namespace touchstone::oracle
