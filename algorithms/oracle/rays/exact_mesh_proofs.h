// Part of the oracle: certificates of rays and points at a mesh.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/oracle/certificates/parts/mesh_certificates.h"

namespace touchstone::oracle {

class MeshProver {
 public:
  // The mesh must outlive this object.
  explicit MeshProver(const TriangleMesh& mesh);

  ~MeshProver();

  // The answer of the ray cast `exact`, and nothing if it has none, as for a direction that is zero.
  std::optional<RayCertificate> prove_ray(const Vec3d& origin, const Vec3d& direction, double t_max,
                                          bool is_first);
  // The answers of the point query `exact`, and nothing if the point is not finite. For a side the surface is
  // closed.
  std::optional<PointCertificate> prove_nearest(const Vec3d& point);
  std::optional<PointCertificate> prove_side(const Vec3d& point);

 private:
  struct Solvers;

  std::array<Vec3d, 3> corners(std::uint32_t triangle) const;

  const TriangleMesh& mesh_;
  std::unique_ptr<Solvers> solvers_;
};

}  // namespace touchstone::oracle
