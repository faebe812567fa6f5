// Parts, boxes around them, and surfaces.
#include "algorithms/oracle/certificates/parts/placed_parts.h"

#include <algorithm>
#include <memory>

namespace touchstone::oracle {
namespace {

constexpr mp_bitcnt_t parts_root_bits = 256;

Solid solid_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  auto hull = std::make_shared<Hull>();
  for (const std::uint32_t corner : mesh.triangles[triangle]) {
    require(corner < mesh.vertices.size(), "a triangle of the mesh names no vertex");
    hull->vertices.push_back(mesh.vertices[corner]);
  }
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return Solid(shape);
}

// The product of all poses that place a part in its body.
RationalPose pose_within(const ConvexPart& part) {
  if (part.rounding == 0 || !part.poses) return rational_pose(part.pose);
  RationalPose product = rational_pose(Pose{});
  for (const Pose& pose : *part.poses) product = composed(product, rational_pose(pose));
  return product;
}

std::optional<RationalBox> box_of(const RationalCore& core) {
  if (core.is_halfspace()) return {};
  std::optional<RationalBox> box;
  if (core.is_polytope()) {
    for (const RationalVector& vertex : core.vertices()) {
      box = box ? around(*box, {vertex, vertex}) : RationalBox{vertex, vertex};
    }
    return box;
  }
  box.emplace();
  for (std::size_t k = 0; k < 3; ++k) {
    RationalVector axis;
    axis[k] = 1;
    box->high[k] = *core.support(axis);
    axis[k] = -1;
    box->low[k] = -*core.support(axis);
  }
  return box;
}

}  // namespace

bool has_rounded_places(const ConcaveBody& body) {
  return std::ranges::any_of(
      body.parts, [](const ConvexPart& part) { return part.rounding != 0 && !part.poses; });
}

PlacedParts::PlacedParts(const ConcaveBody& body, const Pose& pose)
    : body_(body), pose_(rational_pose(pose)) {
  solids_.reserve(body.part_count());
  for (std::uint32_t i = 0; i < body.part_count(); ++i) {
    solids_.push_back(body.mesh ? solid_of(*body.mesh, i) : Solid(body.parts[i].shape));
    const RationalPose within = body.mesh ? rational_pose(Pose{}) : pose_within(body.parts[i]);
    boxes_.push_back(box_of(RationalCore(solids_[i], within, parts_root_bits)));
    require(solids_[i].radius >= 0, "a radius is negative");
    greatest_radius_ = std::max<mpq_class>(greatest_radius_, radius(i));
  }
}

RationalPose PlacedParts::pose_of(std::uint32_t part) const {
  return body_.mesh ? pose_ : composed(pose_, pose_within(body_.parts[part]));
}

RationalCore PlacedParts::core(std::uint32_t part) const {
  return {solids_[part], pose_of(part), parts_root_bits};
}

mpq_class PlacedParts::support(const RationalVector& n, const RationalBox& box) const {
  mpq_class sum = dot(n, pose_.translation);
  const auto& rows = pose_.rows;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class along = n[0] * rows[0][k] + n[1] * rows[1][k] + n[2] * rows[2][k];
    sum += along * (along > 0 ? box.high[k] : box.low[k]);
  }
  return sum;
}

std::uint32_t PlacedParts::surface_count() const {
  return body_.mesh ? 1 : static_cast<std::uint32_t>(body_.surfaces.size());
}

CompoundSurface PlacedParts::surface(std::uint32_t number) const {
  return body_.mesh ? CompoundSurface{body_.mesh, 0} : body_.surfaces[number];
}

std::vector<std::uint32_t> PlacedParts::one_of_each_piece() const {
  std::vector<std::uint32_t> pieces;
  std::vector<bool> is_of_mesh(size());
  for (std::uint32_t i = 0; i < surface_count(); ++i) {
    const auto [mesh, first] = surface(i);
    for (const std::uint32_t triangle : RationalMesh(*mesh).one_of_each_piece()) {
      pieces.push_back(first + triangle);
    }
    std::fill_n(is_of_mesh.begin() + first, mesh->triangles.size(), true);
  }
  for (std::uint32_t i = 0; i < size(); ++i) {
    if (!is_of_mesh[i] && solids_[i].core != Solid::Core::halfspace) pieces.push_back(i);
  }
  return pieces;
}

RationalVector PlacedParts::point_of(std::uint32_t part) const {
  const Solid& given = solids_[part];
  require(given.core != Solid::Core::halfspace, "a half-space is in no surface");
  // A round core has its centre.
  return pose_of(part)(given.vertices.empty() ? RationalVector{}
                                              : rational_vector(given.vertices[0]));
}

RationalMesh PlacedParts::placed_surface(std::uint32_t number) const {
  const auto [mesh, first] = surface(number);
  const RationalMesh exact(*mesh);
  if (mesh->solid) exact.require_closed();
  return exact.placed(pose_of(first));
}

}  // namespace touchstone::oracle
