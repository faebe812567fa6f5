// Part of the oracle, used by the checks of certificates and by what makes them: the parts of a body in their
// places, in rationals.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/oracle/certificates/parts/part_tree.h"
#include "algorithms/oracle/certificates/parts/rational_mesh.h"
#include "algorithms/oracle/certificates/rational_core.h"

namespace touchstone::oracle {

// True if the places of parts were rounded before they were given, and the poses are not known.
bool has_rounded_places(const ConcaveBody& body);

// The body must outlive this object. All throw Fault for what is invalid.
class PlacedParts {
 public:
  PlacedParts(const ConcaveBody& body, const Pose& pose);

  std::uint32_t size() const { return static_cast<std::uint32_t>(solids_.size()); }
  const Solid& solid(std::uint32_t part) const { return solids_[part]; }
  RationalCore core(std::uint32_t part) const;
  mpq_class radius(std::uint32_t part) const { return rational(solids_[part].radius); }
  const mpq_class& greatest_radius() const { return greatest_radius_; }
  bool is_rounded() const { return has_rounded_places(body_); }

  // Boxes around the parts' cores, in body coordinates.
  const std::vector<std::optional<RationalBox>>& boxes() const { return boxes_; }
  // The greatest n . x over the placed box.
  mpq_class support(const RationalVector& n, const RationalBox& box) const;

  // A part of each piece that hangs together: of each of a mesh, and each bounded part that is in no mesh.
  std::vector<std::uint32_t> one_of_each_piece() const;
  // A point of the part, which is bounded: the first vertex of a polytope.
  RationalVector point_of(std::uint32_t part) const;
  // How many meshes there are, and the surface of one in its place, which has to be closed if it is solid.
  std::uint32_t surface_count() const;
  bool is_solid(std::uint32_t surface) const { return this->surface(surface).mesh->solid; }
  RationalMesh placed_surface(std::uint32_t surface) const;

 private:
  // A mesh and its first part.
  CompoundSurface surface(std::uint32_t number) const;
  RationalPose pose_of(std::uint32_t part) const;

  const ConcaveBody& body_;
  RationalPose pose_;
  std::vector<Solid> solids_;
  std::vector<std::optional<RationalBox>> boxes_;
  mpq_class greatest_radius_;
};

}  // namespace touchstone::oracle
