// Makes the hulls of bodies that are not convex, and bounds such bodies.
#include "harness/scene/concave_shape.h"

#include <algorithm>
#include <cmath>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/shapes/compound.h"

namespace touchstone::scene {
namespace {

Shape reduced_hull(const std::vector<Vec3d>& points) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_reduced_hull(points);
  return shape;
}

// A bound on how much longer the matrix makes a vector.
double stretch_of(const Mat3d& rotation) {
  const Mat3d product = (rotation.transpose() * rotation).cwiseAbs();
  return std::sqrt(product.rowwise().sum().maxCoeff()) * (1 + 0x1p-48);
}

}  // namespace

ConcaveShape mesh_shape(geometry::Mesh mesh, MeshUse use) {
  if (use == MeshUse::compound) return compound_shape(geometry::mesh_body(mesh, use));
  ConcaveShape made{reduced_hull(mesh.vertices), nullptr, nullptr};
  if (use != MeshUse::hull) {
    made.body = std::make_shared<const ConcaveBody>(geometry::mesh_body(mesh, use));
  }
  made.mesh = std::make_shared<const geometry::Mesh>(std::move(mesh));
  return made;
}

ConcaveShape compound_shape(ConcaveBody body) {
  geometry::Mesh mesh = geometry::surface_of(body);
  ConcaveShape made{reduced_hull(mesh.vertices), nullptr, nullptr};
  made.mesh = std::make_shared<const geometry::Mesh>(std::move(mesh));
  made.body = std::make_shared<const ConcaveBody>(std::move(body));
  return made;
}

Aabb concave_box(const ConcaveBody& body, const Shape& hull, const Pose& pose) {
  if (body.mesh != nullptr) return tight_box(hull, pose);
  Aabb around = Aabb::empty();
  const double stretch = stretch_of(pose.rotation);
  for (const ConvexPart& part : body.parts) {
    const double reach = reach_of({{tight_box(part.shape, Pose{})}});
    const ComposedPose placed = composed(pose, part.pose, reach);
    const Aabb box = tight_box(part.shape, placed.pose);
    const double slack = placed.error + 2 * stretch * part.rounding;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      around.min[axis] = std::min(around.min[axis], round_down(double{box.min[axis]} - slack));
      around.max[axis] = std::max(around.max[axis], round_up(double{box.max[axis]} + slack));
    }
  }
  return around;
}

double concave_reach(const ConcaveBody& body, const Shape& hull, const Mat3d& rotation) {
  if (body.mesh != nullptr) return loose_reach(hull, rotation);
  double reach = 0;
  for (const ConvexPart& part : body.parts) {
    reach = std::max(reach, part.pose.translation.stableNorm() + part.rounding +
                                loose_reach(part.shape, part.pose.rotation));
  }
  return reach * stretch_of(rotation) * (1 + 0x1p-40);
}

}  // namespace touchstone::scene
