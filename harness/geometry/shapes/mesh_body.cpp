// Makes bodies from meshes.
#include "harness/geometry/shapes/mesh_body.h"

#include <memory>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/mesh_mass.h"

namespace touchstone::geometry {
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
