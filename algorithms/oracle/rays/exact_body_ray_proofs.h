// Part of the oracle: certificates of rays at a body of many parts.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/body_ray_certificate.h"
#include "algorithms/oracle/certificates/parts/ray_at_parts.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

class BodyRayProver {
 public:
  // The body must outlive this object.
  BodyRayProver(const ConcaveBody& body, const Pose& pose);
  ~BodyRayProver();

  // The answer of the ray cast of scenes `exact` with its proof. Of triangles and half-spaces the time is
  // exact, but where another part is hit so shortly after that it hides that; of others it is a bracket, of
  // 2^-50 of the time or as wide as it has to be. Where it finds no proof the answer is unknown. Nothing if the
  // ray is none, and if places of parts were rounded before they were given and the poses are not known.
  std::optional<BodyRayCertificate> prove(const Vec3d& origin, const Vec3d& direction, double t_max,
                                          bool is_first);

 private:
  using Steps = std::vector<BodyRayCertificate::Step>;
  struct Solver;

  mpq_class exact_time(const RaySpan& ray, std::uint32_t part, double t) const;
  bool write_upper(const RaySpan& ray, double t, BodyRayCertificate& certificate);
  void write_lower(const RaySpan& ray, double t, bool tries_upper, BodyRayCertificate& certificate);
  // Whether the parts are free of the span, and how that is shown.
  bool write_cover(const RaySpan& span, BodyRayCertificate& certificate);
  bool walk(const RaySpan& span, const PartNode& node, Steps& steps);
  bool part_is_free(const RaySpan& span, std::uint32_t part, Steps& steps);
  Vec3d way_of(const RaySpan& span) const;

  const ConcaveBody& body_;
  Pose pose_;
  PlacedParts parts_;
  std::vector<std::uint32_t> order_;
  PartTree tree_;
  Oracle oracle_;
  std::unique_ptr<Solver> solver_;
};

}  // namespace touchstone::oracle
