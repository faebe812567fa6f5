// Used by the peers' ray casts: where a ray leaves a mesh for good, and the weights of a hit.
#pragma once

#include <algorithm>
#include <limits>

#include "algorithms/ray_cast.h"

namespace touchstone {

// The bounds of a mesh's triangles.
struct RayReach {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = Vec3d::Constant(std::numeric_limits<double>::lowest());

  explicit RayReach(const TriangleMesh& mesh) {
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t k : triangle) {
        low = low.cwiseMin(mesh.vertices[k]);
        high = high.cwiseMax(mesh.vertices[k]);
      }
    }
  }
  // A t after which the ray meets nothing: t_max, or less for libraries whose rays end.
  double end(const Ray& ray) const {
    const double way = (ray.origin - (low + high) / 2).norm() + (high - low).norm();
    return std::min(ray.t_max, 1.01 * way / ray.direction.norm());
  }
};

// Sets u and v to those of the hit's point; NaN where the triangle has no area.
inline void set_weights(const TriangleMesh& mesh, const Ray& ray, RayHit& hit) {
  const auto& [a, b, c] = mesh.triangles[hit.triangle];
  const Vec3d ab = mesh.vertices[b] - mesh.vertices[a];
  const Vec3d ac = mesh.vertices[c] - mesh.vertices[a];
  const Vec3d at = ray.origin + hit.t * ray.direction - mesh.vertices[a];
  const Vec3d normal = ab.cross(ac);
  hit.u = at.cross(ac).dot(normal) / normal.squaredNorm();
  hit.v = ab.cross(at).dot(normal) / normal.squaredNorm();
}

}  // namespace touchstone
