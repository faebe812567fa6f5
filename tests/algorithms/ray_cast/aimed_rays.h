// Rays for tests of ray casts: aimed at what triangles share, along it, and from it.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/ray_cast.h"
#include "tests/algorithms/ray_cast/meshes.h"

namespace touchstone::reference {

// Rays at vertices, middles of edges and points of faces: from around, from 10^6 away, from there
// on, along edges and in planes of faces, with t_max at the hit and just before it. `share` of a mesh's
// triangles are aimed at.
inline std::vector<Ray> aimed_rays(const TriangleMesh& mesh, double share, unsigned seed) {
  Random random(seed);
  std::vector<Ray> rays;
  const auto add = [&](const Vec3d& origin, const Vec3d& direction, double t_max) {
    if (!direction.isZero(0)) rays.push_back({origin, direction, t_max});
  };
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const auto& triangle : mesh.triangles) {
    if (random.uniform(0, 1) >= share) continue;
    const Vec3d& a = mesh.vertices[triangle[0]];
    const Vec3d& b = mesh.vertices[triangle[1]];
    const Vec3d& c = mesh.vertices[triangle[2]];
    const Vec3d around = a + on_grid(random.vector(8));
    for (const Vec3d& target : {a, Vec3d((a + b) / 2), Vec3d((a + b + 2 * c) / 4)}) {
      add(around, target - around, inf);
      add(around, target - around, 1);
      add(around, target - around, std::nextafter(1.0, 0));
      add(target, on_grid(random.vector(2)), inf);
      add(target, target - around, 0);
      const Vec3d far = target + 1e6 * on_grid(random.direction());
      add(far, target - far, inf);
      // Along an axis, with zeros of either sign.
      const int axis = random.below(3);
      Vec3d along = random.below(2) == 0 ? Vec3d::Zero() : Vec3d(-Vec3d::Zero());
      along[axis] = random.below(2) == 0 ? 1 : -0.5;
      add(target - 4 * along, along, inf);
      add(target, along, 1);
      // In a plane along two axes.
      Vec3d slant = on_grid(random.vector(2));
      slant[axis] = 0;
      add(target - 2 * slant, slant, inf);
    }
    add(a - (b - a), b - a, inf);
    add(b, a - b, inf);
    add((a + b) / 2, b - a, 0.5);
    add(a - (b - a) - (c - a), (b - a) * 2 + (c - a), inf);
    add((a + b + 2 * c) / 4, (b - a) - (c - a), inf);
    add(a + 3 * (b - a) + (c - a), a - b, inf);
    add(b + (c - b) / 4 - 2 * (c - a), c - a, 1.75);
  }
  return rays;
}

// Rays in sixteens that go the same way: from one point, or beside each other, at vertices, edges and faces
// of triangles that are numbered one after the other.
inline std::vector<Ray> rays_in_sixteens(const TriangleMesh& mesh, int count, unsigned seed) {
  Random random(seed);
  std::vector<Ray> rays;
  for (int i = 0; i < count && !mesh.triangles.empty(); ++i) {
    const int first = random.below(static_cast<int>(mesh.triangles.size()));
    const auto vertex = [&](int triangle, std::size_t k) {
      const auto number = static_cast<std::size_t>(first + triangle) % mesh.triangles.size();
      return mesh.vertices[mesh.triangles[number][k]];
    };
    const Vec3d way = on_grid(Vec3d(24 * random.direction()));
    const Vec3d eye = vertex(0, 0) + way;
    for (int k = 0; k < 16; ++k) {
      const Vec3d a = vertex(k / 4, 0), b = vertex(k / 4, 1), c = vertex(k / 4, 2);
      const Vec3d target = k % 4 == 0   ? a
                           : k % 4 == 1 ? Vec3d((a + b) / 2)
                           : k % 4 == 2 ? Vec3d((a + b + 2 * c) / 4)
                                        : Vec3d(b + (b - a) / 8);
      const Vec3d from = i % 2 == 0 ? eye : Vec3d(target + way);
      if (from == target) continue;
      const double t_max = i % 5 == 0 ? 1 : std::numeric_limits<double>::infinity();
      rays.push_back({from, target - from, t_max});
    }
  }
  return rays;
}

// Rays from around the mesh in any direction, half of them at a point near one of its triangles.
inline std::vector<Ray> random_rays(const TriangleMesh& mesh, int count, unsigned seed) {
  Random random(seed);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Ray ray{random.vector(6), random.direction(), random.uniform(0, 20)};
    if (!mesh.vertices.empty()) {
      const int number = random.below(static_cast<int>(mesh.vertices.size()));
      const Vec3d& at = mesh.vertices[static_cast<std::size_t>(number)];
      ray.origin += at;
      if (i % 2 == 0) ray.direction = at + random.vector(0.5) - ray.origin;
    }
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace touchstone::reference
