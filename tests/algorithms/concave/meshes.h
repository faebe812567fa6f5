// Meshes for tests.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "tests/algorithms/concave/phases.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::reference {

inline ConcaveBody body_of(TriangleMesh mesh) {
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), {}};
}
inline ConcaveBody body_of(Shape shape, Pose pose = {}) { return {nullptr, {{shape, pose, 0}}}; }

// A closed torus about z, of 2 around * across triangles. Its surface looks outward.
inline TriangleMesh torus(int around, int across, double radius, double tube, bool solid = false) {
  TriangleMesh mesh;
  mesh.solid = solid;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = radius + tube * std::cos(v);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
      const auto at = [&](int k, int l) {
        return static_cast<std::uint32_t>(k % around * across + l % across);
      };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// The twelve triangles of a box about the origin, outward.
inline TriangleMesh box_mesh(double x, double y, double z, bool solid = false) {
  TriangleMesh mesh;
  mesh.solid = solid;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline Pose moved_by(const Vec3d& translation) { return {Mat3d::Identity(), translation}; }

}  // namespace touchstone::reference
