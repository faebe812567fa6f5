// Places parts of compounds, puts their surfaces together, and makes bodies from meshes.
#include "harness/geometry/concave_bodies.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::geometry {
namespace {

constexpr int polytope_level = 3;

void add_triangle(Mesh& mesh, std::size_t first, std::size_t a, std::size_t b, std::size_t c) {
  const auto at = [first](std::size_t i) { return static_cast<std::uint32_t>(first + i); };
  mesh.triangles.push_back({at(a), at(b), at(c)});
}

void add_part(Mesh& mesh, const ConvexPart& part) {
  if (part.shape.kind == ShapeKind::halfspace) return;
  std::shared_ptr<const Hull> hull = as_polytope(part.shape, polytope_level).hull;
  if (hull->faces.empty() && hull->dimension == 3) hull = make_hull(hull->vertices);
  const std::size_t first = mesh.vertices.size();
  for (const Vec3d& vertex : hull->vertices) mesh.vertices.push_back(part.pose(vertex));
  for (const Hull::Face& face : hull->faces) {
    for (std::size_t i = 1; i + 1 < face.loop.size(); ++i) {
      add_triangle(mesh, first, face.loop[0], face.loop[i], face.loop[i + 1]);
    }
  }
  if (!hull->faces.empty()) return;
  // A flat hull has no faces. The triangles of one vertex and any two others cover it.
  for (std::size_t i = 1; i < hull->vertices.size(); ++i) {
    for (std::size_t k = i + 1; k < hull->vertices.size(); ++k) {
      add_triangle(mesh, first, 0, i, k);
    }
  }
}

}  // namespace

void place_within(std::span<const Pose> around, ConvexPart& part) {
  const double reach = reach_of({{tight_box(part.shape, Pose{})}});
  std::vector<Pose> poses(around.begin(), around.end());
  if (part.poses) {
    poses.insert(poses.end(), part.poses->begin(), part.poses->end());
  } else {
    poses.push_back(part.pose);
  }
  for (auto outer = around.rbegin(); outer != around.rend(); ++outer) {
    const double stretch = outer->rotation.cwiseAbs().rowwise().sum().maxCoeff();
    const ComposedPose placed = composed(*outer, part.pose, reach);
    part.pose = placed.pose;
    part.rounding = 2 * stretch * part.rounding + placed.error;
  }
  if (part.rounding != 0) part.poses = std::make_shared<const std::vector<Pose>>(std::move(poses));
}

void add_surface(std::shared_ptr<const TriangleMesh> mesh, const Pose& pose,
                 std::span<const Pose> around, ConcaveBody& compound) {
  if (mesh->triangles.empty()) return;
  const auto first = static_cast<std::uint32_t>(compound.parts.size());
  for (const auto& corners : mesh->triangles) {
    ConvexPart& part = compound.parts.emplace_back();
    part.shape.kind = ShapeKind::hull;
    part.shape.hull = make_hull(
        {mesh->vertices[corners[0]], mesh->vertices[corners[1]], mesh->vertices[corners[2]]});
    part.pose = pose;
    place_within(around, part);
  }
  compound.surfaces.push_back({std::move(mesh), first});
}

Mesh surface_of(const ConcaveBody& compound) {
  Mesh mesh;
  std::vector<bool> is_of_surface(compound.parts.size());
  for (const CompoundSurface& surface : compound.surfaces) {
    const std::size_t first = mesh.vertices.size();
    const Pose& pose = compound.parts[surface.first].pose;
    for (const Vec3d& vertex : surface.mesh->vertices) mesh.vertices.push_back(pose(vertex));
    for (const auto& [a, b, c] : surface.mesh->triangles) add_triangle(mesh, first, a, b, c);
    std::fill_n(is_of_surface.begin() + surface.first, surface.mesh->triangles.size(), true);
  }
  for (std::size_t i = 0; i < compound.parts.size(); ++i) {
    if (!is_of_surface[i]) add_part(mesh, compound.parts[i]);
  }
  return mesh;
}

std::optional<std::pair<Vec3d, Vec3d>> open_edge(
    std::span<const Vec3d> vertices, std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::map<std::array<double, 3>, std::uint32_t> number_of;
  std::vector<Vec3d> places;
  const auto number = [&](std::uint32_t vertex) {
    const Vec3d& at = vertices[vertex];
    const auto next = static_cast<std::uint32_t>(places.size());
    const auto [known, is_new] = number_of.try_emplace({at[0], at[1], at[2]}, next);
    if (is_new) places.push_back(at);
    return known->second;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& corners : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t tail = number(corners[k]), head = number(corners[(k + 1) % 3]);
      if (tail != head) balance[std::minmax(tail, head)] += tail < head ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) return {{places[edge.first], places[edge.second]}};
  }
  return {};
}

namespace {

void add_hull(const Mesh& mesh, ConcaveBody& body) {
  Shape& shape = body.parts.emplace_back().shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_reduced_hull(mesh.vertices);
}

}  // namespace

ConcaveBody mesh_body(const Mesh& mesh, MeshUse use) {
  ConcaveBody body;
  if (use == MeshUse::hull) {
    add_hull(mesh, body);
  } else if (use == MeshUse::compound) {
    for (const Mesh& part : connected_parts(mesh)) add_hull(part, body);
  } else {
    auto triangles = std::make_shared<TriangleMesh>();
    triangles->vertices = mesh.vertices;
    triangles->triangles = mesh.triangles;
    triangles->solid = use == MeshUse::solid;
    body.mesh = std::move(triangles);
  }
  return body;
}

}  // namespace touchstone::geometry
