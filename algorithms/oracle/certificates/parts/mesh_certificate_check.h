// Part of the oracle: the independent check of what rays and points at a mesh claim.
#pragma once

#include <optional>
#include <string>

#include "algorithms/oracle/certificates/parts/mesh_certificates.h"
#include "algorithms/oracle/certificates/parts/part_tree.h"
#include "algorithms/oracle/certificates/parts/rational_mesh.h"

namespace touchstone::oracle {

// A mesh at which rays and points are checked, prepared once.
class CheckedMesh {
 public:
  explicit CheckedMesh(const TriangleMesh& mesh);

  // Return why a certificate does not prove its claim, or an empty string if it does.
  std::string fault(const RayCertificate& certificate) const;
  std::string fault(const PointCertificate& certificate) const;

 private:
  void require_proven(const RayCertificate& certificate) const;
  void require_closest(const PointCertificate& certificate) const;
  void require_side(const PointCertificate& certificate) const;

  std::string invalid_;  // why the mesh is none
  std::optional<RationalMesh> mesh_;
  std::optional<PartTree> tree_;
  std::string open_;  // why it has no sides
};

}  // namespace touchstone::oracle
