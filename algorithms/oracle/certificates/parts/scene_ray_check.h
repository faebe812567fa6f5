// Part of the oracle: the independent check of a certificate of a ray at bodies of many parts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"
#include "algorithms/oracle/certificates/parts/placed_parts.h"
#include "algorithms/oracle/certificates/parts/ray_at_parts.h"
#include "algorithms/oracle/certificates/parts/scene_ray_certificate.h"

namespace touchstone::oracle {

// Bodies at which rays are checked. They must outlive this object. The parts of one are prepared when they are first
// asked for.
class CheckedScene {
 public:
  explicit CheckedScene(std::vector<PlacedBody> bodies);

  // Returns why the certificate does not prove its claim, or an empty string if it does.
  std::string fault(const SceneRayCertificate& certificate);

 private:
  const PlacedParts& parts_of(std::uint32_t body);
  void require_proven(const SceneRayCertificate& certificate);
  // All parts are free of the span, but for the one that is hit, if any, which is until its own time.
  void require_free(const SceneRayCertificate& certificate, const RaySpan& span,
                    const PartUntil* hit);

  std::vector<PlacedBody> bodies_;
  std::vector<std::optional<RationalBox>> boxes_;  // in the world
  std::vector<std::unique_ptr<PlacedParts>> parts_;
  std::string invalid_;  // why one of the bodies is none
};

}  // namespace touchstone::oracle
