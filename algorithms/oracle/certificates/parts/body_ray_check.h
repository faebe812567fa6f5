// Part of the oracle: the independent check of a certificate of a ray at a body of many parts.
#pragma once

#include <optional>
#include <string>

#include "algorithms/oracle/certificates/parts/body_ray_certificate.h"
#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"
#include "algorithms/oracle/certificates/parts/placed_parts.h"

namespace touchstone::oracle {

// A body at which rays are checked, prepared once. It must outlive this object.
class CheckedBody {
 public:
  explicit CheckedBody(const PlacedBody& body);

  // Returns why the certificate does not prove its claim, or an empty string if it does.
  std::string fault(const BodyRayCertificate& certificate) const;

 private:
  void require_proven(const BodyRayCertificate& certificate) const;

  std::optional<PlacedParts> parts_;
  std::string invalid_;  // why the body is none
};

}  // namespace touchstone::oracle
