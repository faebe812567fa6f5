// Makes meshes.
#include "harness/families/meshes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "harness/families/draws.h"

namespace touchstone::families {

TriangleMesh ellipsoid_mesh(const Vec3d& radii, std::uint32_t around, std::uint32_t rings) {
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

TriangleMesh terrain_mesh(std::uint32_t side, double height, std::uint64_t seed) {
  RandomDraws random(seed);
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

TriangleMesh soup_mesh(int count, std::uint64_t seed) {
  RandomDraws random(seed);
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

void add(TriangleMesh& mesh, const TriangleMesh& other, double scale, const Vec3d& by) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3d& v : other.vertices) mesh.vertices.push_back(scale * v + by);
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

TriangleMesh moved(const TriangleMesh& mesh, double scale, const Vec3d& by) {
  TriangleMesh other;
  add(other, mesh, scale, by);
  return other;
}

std::vector<NamedMesh> ray_meshes() {
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

TriangleMesh torus(int around, int across, double radius, double tube, bool solid) {
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

TriangleMesh box_mesh(double x, double y, double z, bool solid) {
  TriangleMesh mesh;
  mesh.solid = solid;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

std::vector<NamedMesh> closed_meshes() {
  std::vector<NamedMesh> all;
  all.push_back({"none", {}});
  all.push_back({"ball", ellipsoid_mesh({2, 2, 2}, 8, 6)});
  all.push_back({"poles", ellipsoid_mesh({3, 2, 1}, 160, 4)});
  NamedMesh nested{"nested", ellipsoid_mesh({2, 2, 2}, 8, 6)};
  TriangleMesh hole = ellipsoid_mesh({1, 1, 1}, 7, 5);
  for (auto& triangle : hole.triangles) std::swap(triangle[0], triangle[1]);
  add(nested.mesh, hole, 1, {0, 0, 0});
  add(nested.mesh, ellipsoid_mesh({1, 1, 1}, 6, 4), 1, {1.5, 0, 0});
  all.push_back(std::move(nested));
  all.push_back({"doubles", moved(ellipsoid_mesh({2, 1, 2}, 10, 6), 1 / 3.0, {0.1, 0.2, 0.7})});
  return all;
}

}  // namespace touchstone::families
