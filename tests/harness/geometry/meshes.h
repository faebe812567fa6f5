// Closed meshes that are not convex.
#pragma once

#include <cmath>
#include <numbers>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/mesh_solid.h"

namespace touchstone {

// A torus around z with the radii of ring and tube, in n by m quadrangles.
inline geometry::Mesh torus(double ring, double tube, int n, int m) {
  geometry::Mesh mesh;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
      const double r = ring + tube * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % n * m + j % m); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// An L of volume 3, two long each way and one thick.
inline geometry::Mesh angle_bracket() {
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  geometry::Mesh mesh;
  for (double z : {0.0, 1.0}) {
    for (const auto& p : outline) mesh.vertices.emplace_back(p[0], p[1], z);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  constexpr std::uint32_t flat[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& t : flat) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  return mesh;
}

// The boundary of a cube; turned inside out it is that of a cavity.
inline geometry::Mesh cube_mesh(double half, bool inside_out) {
  geometry::Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  }
  constexpr std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  if (inside_out) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

// A cube of 4 with a cubic cavity of 2 in it, or the same turned inside out; a volume of 56.
inline geometry::Mesh hollow_cube(bool inside_out) {
  geometry::Mesh mesh = cube_mesh(2, inside_out);
  const geometry::Mesh cavity = cube_mesh(1, !inside_out);
  mesh.vertices.insert(mesh.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  for (const auto& [a, b, c] : cavity.triangles) mesh.triangles.push_back({a + 8, b + 8, c + 8});
  return mesh;
}

inline Shape hull_of(const geometry::Mesh& mesh) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_reduced_hull(mesh.vertices);
  return shape;
}

}  // namespace touchstone
