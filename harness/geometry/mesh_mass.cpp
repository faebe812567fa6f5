// Centre of mass and connected parts.
#include "harness/geometry/mesh_mass.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/base/reproducible_math.h"

namespace touchstone::geometry {
namespace {

Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

double dot(const Vec3d& a, const Vec3d& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }

}  // namespace

Vec3d centre_of_mass(const Mesh& mesh) {
  const std::vector<Vec3d>& v = mesh.vertices;
  Vec3d low = v.front(), high = v.front(), mean = Vec3d::Zero();
  for (const Vec3d& p : v) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    mean += (p - v.front()) / static_cast<double>(v.size());
  }
  // Moments are relative to the first vertex: tetrahedra between it and the triangles, and the
  // triangles.
  double volume = 0, area = 0, size = 0;
  Vec3d volume_moment = Vec3d::Zero(), area_moment = Vec3d::Zero();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3d a = v[i] - v.front(), b = v[j] - v.front(), c = v[k] - v.front();
    const double six_volumes = dot(a, cross(b, c));
    const double two_areas = base::length(cross(b - a, c - a));
    volume += six_volumes;
    size += std::abs(six_volumes);
    volume_moment += six_volumes / 4 * (a + b + c);
    area += two_areas;
    area_moment += two_areas / 3 * (a + b + c);
  }
  if (std::abs(volume) > 1e-9 * size) {
    const Vec3d centre = v.front() + volume_moment / volume;
    if ((centre.array() >= low.array()).all() && (centre.array() <= high.array()).all()) {
      return centre;
    }
  }
  if (area > 0) return v.front() + area_moment / area;
  return v.front() + mean;
}

std::vector<Mesh> connected_parts(const Mesh& mesh) {
  std::vector<std::size_t> parent(mesh.triangles.size());
  for (std::size_t t = 0; t < parent.size(); ++t) parent[t] = t;
  const auto root = [&](std::size_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> by_edge;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      const auto [other, is_new] = by_edge.insert({{std::min(a, b), std::max(a, b)}, t});
      if (is_new) continue;
      // The earlier triangle stays the root, so that parts are in the order of their first
      // triangles.
      const std::size_t a_root = root(t), b_root = root(other->second);
      parent[std::max(a_root, b_root)] = std::min(a_root, b_root);
    }
  }
  std::map<std::size_t, std::pair<Mesh, std::map<std::uint32_t, std::uint32_t>>> parts;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto& [part, renumbered] = parts[root(t)];
    std::array<std::uint32_t, 3> triangle = mesh.triangles[t];
    for (std::uint32_t& v : triangle) {
      const auto [at, is_new] =
          renumbered.insert({v, static_cast<std::uint32_t>(part.vertices.size())});
      if (is_new) part.vertices.push_back(mesh.vertices[v]);
      v = at->second;
    }
    part.triangles.push_back(triangle);
  }
  std::vector<Mesh> result;
  for (auto& [first, part] : parts) result.push_back(std::move(part.first));
  return result;
}

}  // namespace touchstone::geometry
