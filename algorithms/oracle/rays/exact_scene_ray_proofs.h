// Part of the oracle: certificates of rays at bodies of many parts.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"
#include "algorithms/oracle/certificates/parts/scene_ray_certificate.h"
#include "algorithms/oracle/rays/body_at_rays.h"

namespace touchstone::oracle {

class SceneRayProver {
 public:
  // The bodies must outlive this object.
  explicit SceneRayProver(std::vector<PlacedBody> bodies);
  ~SceneRayProver();

  // The answer of the ray cast of scenes `exact` with its proof. Of triangles and half-spaces the time is
  // exact, but where another part is hit so shortly after that it hides that; of others it is a bracket, of
  // 2^-50 of the time or as wide as it has to be. It is without order where other parts are hit in it, or nearly.
  // Where it finds no proof the answer is unknown. Nothing if the ray is none, and if places of parts were rounded before they were given and the poses are not known.
  std::optional<SceneRayCertificate> prove(const Vec3d& origin, const Vec3d& direction,
                                           double t_max, bool is_first);

 private:
  struct Solver;

  BodyAtRays& at(std::uint32_t body);
  void write_lower(const RaySpan& ray, double t, bool has_upper, SceneRayCertificate& certificate);
  // Whether all parts of all bodies are free of the span, but for the one that is hit, if any, which is until its
  // own time; and how that is shown.
  bool write_cover(const RaySpan& span, const PartUntil* hit, SceneRayCertificate& certificate);
  bool walk(const RaySpan& span, const PartUntil* hit, const PartNode& node,
            SceneRayCertificate& certificate);

  std::vector<PlacedBody> bodies_;
  std::vector<std::optional<RationalBox>> boxes_;  // in the world
  std::vector<std::uint32_t> order_;
  PartTree tree_;
  bool has_rounded_ = false;                     // places of parts of any body were rounded
  double reach_ = 0;                             // of the boxes
  std::vector<std::unique_ptr<BodyAtRays>> at_;  // those that were needed
  std::unique_ptr<Solver> solver_;
};

}  // namespace touchstone::oracle
