// Boxes, reach and pieces of a body.
#include "algorithms/concave/part_pairs/bound_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/skew.h"

namespace touchstone {
namespace {

Aabb box_of(const TriangleCorners& corners) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    box.min[axis] = round_down(low);
    box.max[axis] = round_up(high);
  }
  return box;
}

// The radius of the ball around the part's core, which no pose stretches.
double round_radius(const Shape& shape) {
  const bool is_round = shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::capsule;
  return is_round ? shape.radius : 0;
}

Aabb box_of(const ConvexPart& part, double growth) {
  Aabb box = tight_box(part.shape, part.pose);
  const double radius = round_radius(part.shape);
  const double more = part.rounding + (radius > 0 ? radius * (growth - 1) : 0);
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = round_down(box.min[axis] - more);
    box.max[axis] = round_up(box.max[axis] + more);
  }
  return box;
}

// At least the factor by which the matrix shrinks a vector most; infinite if it may flatten one.
double shrinking(const Mat3d& rotation) {
  const double skew = skew_of(rotation);
  // No singular value is below the root of 1 - skew.
  if (skew <= 0.5) return 1 + skew;
  const double greatest = rotation.cwiseAbs().maxCoeff();
  if (!(greatest > 0)) return std::numeric_limits<double>::infinity();
  // The determinant is the product of the singular values, and that of the two greatest ones is at
  // most half of the sum of all squares.
  const Mat3d scaled = rotation / greatest;
  const double volume = std::abs(scaled.determinant());
  if (!(volume > 1e-12)) return std::numeric_limits<double>::infinity();
  return 1.01 * scaled.squaredNorm() / (2 * volume) / greatest;
}

double reach_of(const TriangleMesh& mesh) {
  double reach = 0;
  for (const Vec3d& vertex : mesh.vertices) reach = std::max(reach, vertex.cwiseAbs().maxCoeff());
  return reach;
}

// A corner of each piece of the mesh that its triangles' common corners connect.
std::vector<std::uint32_t> corners_of_pieces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> above(mesh.vertices.size());
  std::iota(above.begin(), above.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (above[v] != v) v = above[v] = above[above[v]];
    return v;
  };
  for (const auto& corners : mesh.triangles) {
    above[root(corners[1])] = root(corners[0]);
    above[root(corners[2])] = root(corners[0]);
  }
  std::vector<std::uint32_t> pieces;
  for (const auto& corners : mesh.triangles) {
    const std::uint32_t top = root(corners[0]);
    if (above[top] == top) pieces.push_back(top);
  }
  std::ranges::sort(pieces);
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

}  // namespace

BoundBody::BoundBody(const ConcaveBody& body) : given(&body) {
  if (body.mesh) {
    boxes = made_boxes();
    reach = reach_of(*body.mesh);
  } else {
    fill_boxes();
  }
  add_pieces();
}

void BoundBody::add_pieces() {
  const auto add_surface = [&](const TriangleMesh& mesh, std::uint32_t part) {
    const double far = reach_of(mesh);
    for (const std::uint32_t corner : corners_of_pieces(mesh)) {
      pieces.push_back({mesh.vertices[corner], part, far});
    }
    if (mesh.solid) solids.push_back({&mesh, part, far});
  };
  if (mesh() != nullptr) add_surface(*mesh(), 0);
  auto surface = given->surfaces.begin();
  for (std::uint32_t i = 0; i < given->parts.size();) {
    if (surface != given->surfaces.end() && surface->first == i) {
      add_surface(*surface->mesh, i);
      i += static_cast<std::uint32_t>(surface++->mesh->triangles.size());
      continue;
    }
    const Shape& shape = given->parts[i].shape;
    if (shape.kind != ShapeKind::halfspace) {
      const Vec3d point =
          shape.kind == ShapeKind::hull ? shape.hull->vertices[0] : Vec3d(Vec3d::Zero());
      pieces.push_back({point, i, point.cwiseAbs().maxCoeff()});
    }
    ++i;
  }
}

ComposedPose BoundBody::place(const Pose& pose, std::uint32_t part, double far) const {
  if (mesh() != nullptr) return {pose, 0};
  const ConvexPart& convex = given->parts[part];
  ComposedPose placed = composed(pose, convex.pose, far);
  placed.error += 2 * pose.rotation.cwiseAbs().rowwise().sum().maxCoeff() * convex.rounding;
  return placed;
}

std::vector<Aabb> BoundBody::made_boxes() const {
  std::vector<Aabb> made;
  made.reserve(given->part_count());
  for (std::uint32_t i = 0; i < given->part_count(); ++i) made.push_back(box_of(corners(i)));
  return made;
}

void BoundBody::fill_boxes() {
  boxes.clear();
  for (const ConvexPart& part : given->parts) {
    boxes.push_back(box_of(part, radius_growth));
    for (const auto& corner : {boxes.back().min, boxes.back().max}) {
      for (const float x : corner) {
        if (std::isfinite(x)) reach = std::max(reach, double{std::abs(x)});
      }
    }
  }
}

bool BoundBody::enclose(const Mat3d& rotation) {
  const auto is_round = [](const ConvexPart& part) { return round_radius(part.shape) > 0; };
  if (std::ranges::none_of(given->parts, is_round)) return false;
  const double least = shrinking(rotation);
  if (least <= radius_growth) return false;
  // Powers of two, so that slowly shrinking bodies get new boxes seldom.
  radius_growth = std::exp2(std::ceil(std::log2(least)));
  fill_boxes();
  return true;
}

}  // namespace touchstone
