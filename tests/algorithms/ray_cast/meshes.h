// Meshes for tests of ray casts. Coordinates are multiples of 2^-10, so that sums, differences and
// halves of them are exact.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "tests/algorithms/random.h"

namespace touchstone::reference {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

inline double on_grid(double x) { return std::round(x * 1024) / 1024; }
inline Vec3d on_grid(const Vec3d& v) { return {on_grid(v[0]), on_grid(v[1]), on_grid(v[2])}; }

// A closed ellipsoid; at its two poles `around` triangles meet.
inline TriangleMesh ellipsoid_mesh(const Vec3d& radii, std::uint32_t around, std::uint32_t rings) {
  TriangleMesh mesh;
  for (std::uint32_t i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (std::uint32_t j = 0; j < around; ++j) {
      const double turn = 2 * std::numbers::pi * j / around;
      mesh.vertices.push_back(
          on_grid({radii[0] * std::sin(polar) * std::cos(turn),
                   radii[1] * std::sin(polar) * std::sin(turn), radii[2] * std::cos(polar)}));
    }
  }
  const auto north = static_cast<std::uint32_t>(mesh.vertices.size()), south = north + 1;
  mesh.vertices.push_back(on_grid({0, 0, radii[2]}));
  mesh.vertices.push_back(on_grid({0, 0, -radii[2]}));
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t next = (j + 1) % around, last = (rings - 2) * around;
    mesh.triangles.push_back({north, j, next});
    mesh.triangles.push_back({south, last + next, last + j});
    for (std::uint32_t i = 0; i + 2 < rings; ++i) {
      const std::uint32_t upper = i * around, lower = upper + around;
      mesh.triangles.push_back({upper + j, lower + j, upper + next});
      mesh.triangles.push_back({upper + next, lower + j, lower + next});
    }
  }
  mesh.solid = true;
  return mesh;
}

// An open grid of side * side squares of size 1, with heights up to `height`.
inline TriangleMesh terrain_mesh(std::uint32_t side, double height, unsigned seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t j = 0; j <= side; ++j) {
      mesh.vertices.emplace_back(i, j, on_grid(random.uniform(0, height)));
    }
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({a + 1, b, b + 1});
    }
  }
  return mesh;
}

// Triangles without order, some of them degenerate or there twice.
inline TriangleMesh soup_mesh(int count, unsigned seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < 3 * count; ++i) mesh.vertices.push_back(on_grid(random.vector(4)));
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::uint32_t>(3 * i);
    if (i % 4 == 1) mesh.vertices[k + 2] = 2 * mesh.vertices[k + 1] - mesh.vertices[k];
    if (i % 8 == 3) mesh.vertices[k + 1] = mesh.vertices[k + 2] = mesh.vertices[k];
    mesh.triangles.push_back({k, k + 1, k + 2});
    if (i % 4 == 2) mesh.triangles.push_back({k + 1, k, k + 2});
  }
  return mesh;
}

inline void add(TriangleMesh& mesh, const TriangleMesh& other, double scale, const Vec3d& by) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3d& v : other.vertices) mesh.vertices.push_back(scale * v + by);
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

inline TriangleMesh moved(const TriangleMesh& mesh, double scale, const Vec3d& by) {
  TriangleMesh other;
  add(other, mesh, scale, by);
  return other;
}

// The meshes of the families, small enough for the oracle.
inline std::vector<NamedMesh> ray_meshes() {
  std::vector<NamedMesh> all;
  all.push_back({"none", {}});
  all.push_back({"one", {{{0, 0, 0}, {3, 0, 1}, {0, 2, 1}}, {{0, 1, 2}}, false}});
  all.push_back({"point", {{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}, false}});
  all.push_back({"ball", ellipsoid_mesh({2, 2, 2}, 8, 6)});
  all.push_back({"poles", ellipsoid_mesh({3, 2, 1}, 160, 4)});
  all.push_back({"terrain", terrain_mesh(10, 2, 3)});
  all.push_back({"flat", terrain_mesh(8, 0, 3)});
  all.push_back({"soup", soup_mesh(120, 5)});
  NamedMesh two{"far and near", ellipsoid_mesh({2, 2, 2}, 8, 6)};
  add(two.mesh, ellipsoid_mesh({1, 2, 1}, 7, 5), 1, {8, 1, 0});
  add(two.mesh, ellipsoid_mesh({1, 1, 1}, 6, 4), 0x1p-20, {0.5, 0.5, 0.5});
  add(two.mesh, terrain_mesh(2, 1, 7), 0x1p10, {-64, -64, -64});
  all.push_back(std::move(two));
  // The vertex in the middle of the longer edge is none of the other triangle.
  all.push_back({"t-junction",
                 {{{0, 0, 0}, {4, 0, 0}, {2, 3, 1}, {2, 0, 0}, {1, -3, 1}, {3, -3, 1}},
                  {{0, 1, 2}, {0, 3, 4}, {3, 1, 5}},
                  false}});
  all.push_back({"shifted", moved(ellipsoid_mesh({2, 2, 2}, 8, 6), 1, {0x1p20, -0x1p20, 0x1p19})});
  // None of these vertices is a float.
  all.push_back({"doubles", moved(ellipsoid_mesh({2, 1, 2}, 10, 6), 1 / 3.0, {0.1, 0.2, 0.7})});
  all.push_back({"shifted doubles", moved(soup_mesh(40, 9), 1 / 3.0, {1e6 + 0.1, 0.2, -1e6})});
  return all;
}

}  // namespace touchstone::reference
