// Part of the oracle: what certificates of rays say about one body of many parts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/ray_at_parts.h"
#include "algorithms/oracle/certificates/parts/scene_ray_certificate.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

// Brackets of times reach so many bits of the time around it; they are tried in this order.
inline constexpr std::array bits_of_brackets = {52, 50, 47, 44, 40, 36, 32, 28, 24, 20};

TimeFraction time_fraction(const mpq_class& t);

class BodyAtRays {
 public:
  // The body must outlive this object.
  BodyAtRays(const ConcaveBody& body, const Pose& pose);

  // Writes a time at which the part of the certificate has the point of the ray, about t, and what shows it; false,
  // and nothing, if none is found.
  bool write_upper(const RaySpan& ray, double t, SceneRayCertificate& certificate);
  // Whether the parts are free of the span, but for the one that is hit, if any, which is until its own time; and how
  // that is shown. The cover is complete only then.
  bool write_cover(const RaySpan& span, const PartUntil* hit, SceneRayCertificate::Cover& cover);

 private:
  using Steps = std::vector<SceneRayCertificate::Step>;

  mpq_class exact_time(const RaySpan& ray, std::uint32_t part, double t) const;
  bool walk(const RaySpan& span, const PartUntil* hit, const PartNode& node, Steps& steps);
  bool part_is_free(const RaySpan& span, std::uint32_t part, Steps& steps);

  const ConcaveBody& body_;
  Pose pose_;
  PlacedParts parts_;
  std::vector<std::uint32_t> order_;
  PartTree tree_;
  double reach_;  // of the body from the world's origin (metres)
  Oracle oracle_;
};

}  // namespace touchstone::oracle
