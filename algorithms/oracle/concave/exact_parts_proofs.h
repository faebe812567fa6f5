// Part of the oracle: certificates of two bodies of many parts.
#pragma once

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/parts_certificate.h"

namespace touchstone::oracle {

// The answer of the concave phase `exact` with its proof. Where curved parts are too near to each other to tell it is
// unknown, as that is, and where places of parts were rounded before they were given and the poses
// are not known.
PartsCertificate prove_parts(PartsCertificate::Claim claim, const ConcaveBody& a,
                             const Pose& pose_a, const ConcaveBody& b, const Pose& pose_b);

}  // namespace touchstone::oracle
