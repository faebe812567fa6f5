// Meshes for tests.
#pragma once

#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/concave/phases.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::reference {

inline ConcaveBody body_of(TriangleMesh mesh) {
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), {}};
}
inline ConcaveBody body_of(Shape shape, Pose pose = {}) { return {nullptr, {{shape, pose, 0}}}; }

// Adds the triangles of a mesh as parts of a compound, at this pose.
inline void add_surface(ConcaveBody& body, TriangleMesh mesh, const Pose& pose,
                        double rounding = 0) {
  const auto first = static_cast<std::uint32_t>(body.parts.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    body.parts.push_back(
        {hull_of({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}), pose, rounding});
  }
  body.surfaces.push_back({std::make_shared<const TriangleMesh>(std::move(mesh)), first});
}

using families::box_mesh;
using families::torus;

inline Pose moved_by(const Vec3d& translation) { return {Mat3d::Identity(), translation}; }

}  // namespace touchstone::reference
