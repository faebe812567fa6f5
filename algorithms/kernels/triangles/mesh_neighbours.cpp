// Steps: 1. Give equal vertices one number, and list all edges with the corners opposite to them.
//        2. To ask about a point, tell by its weights whether it is in a triangle's face, on an edge or at a
//           vertex, and look at the corners of the triangles that share that.
#include "algorithms/kernels/triangles/mesh_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace touchstone {
namespace {

// A corner whose weight is at most this is not one of the point's feature.
constexpr double least_weight = 1e-9;
// The sine of an angle by which a neighbour may stand out.
constexpr double slack = 1e-6;

// The weights of the point in the triangle's plane; not finite if the triangle has no area.
Vec3d weights_of(const std::array<Vec3d, 3>& corner, const Vec3d& point) {
  const Vec3d ab = corner[1] - corner[0], ac = corner[2] - corner[0], ap = point - corner[0];
  const Vec3d normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  const double v = normal.dot(ap.cross(ac)) / area, w = normal.dot(ab.cross(ap)) / area;
  return {1 - v - w, v, w};
}

}  // namespace

MeshNeighbours::MeshNeighbours(const TriangleMesh& mesh)
    : mesh_(mesh), place_of_(mesh.vertices.size()) {
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto coordinates = [&](std::uint32_t i) {
    const Vec3d& v = mesh.vertices[i];
    return std::tuple(v.x(), v.y(), v.z());
  };
  std::ranges::sort(order, {}, coordinates);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_same = k > 0 && coordinates(order[k]) == coordinates(order[k - 1]);
    place_of_[order[k]] = is_same ? place_of_[order[k - 1]] : order[k];
  }
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = place_of_[triangle[k]], q = place_of_[triangle[(k + 1) % 3]];
      if (p == q) continue;
      edges_.push_back({std::min(p, q), std::max(p, q), place_of_[triangle[(k + 2) % 3]]});
      beside_.emplace_back(p, q);
      beside_.emplace_back(q, p);
    }
  }
  std::ranges::sort(edges_, {}, [](const Edge& e) { return std::tuple(e.low, e.high, e.apex); });
  std::ranges::sort(beside_);
  const auto repeated = std::ranges::unique(beside_);
  beside_.erase(repeated.begin(), repeated.end());
}

bool MeshNeighbours::supports(std::uint32_t triangle, const Pose& pose, const Vec3d& point,
                              const Vec3d& normal) const {
  const auto is_behind = [&](std::uint32_t place) {
    const Vec3d way = pose(mesh_.vertices[place]) - point;
    return !(normal.dot(way) > slack * way.norm());
  };
  std::array<std::uint32_t, 3> place;
  std::array<Vec3d, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    place[k] = place_of_[mesh_.triangles[triangle][k]];
    corner[k] = pose(mesh_.vertices[place[k]]);
  }
  if (!std::ranges::all_of(place, is_behind)) return false;
  const Vec3d weights = weights_of(corner, point);
  std::array<std::uint32_t, 3> feature;
  std::size_t corners = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(weights[static_cast<int>(k)] <= least_weight)) feature[corners++] = place[k];
  }
  if (corners == 1) {
    const auto around = std::ranges::equal_range(beside_, feature[0], {},
                                                 &std::pair<std::uint32_t, std::uint32_t>::first);
    return std::ranges::all_of(around, [&](const auto& pair) { return is_behind(pair.second); });
  }
  if (corners == 2) {
    const auto [low, high] = std::minmax(feature[0], feature[1]);
    const auto ends = [](const Edge& e) { return std::pair(e.low, e.high); };
    const auto apexes = std::ranges::equal_range(edges_, std::pair(low, high), {}, ends);
    return std::ranges::all_of(apexes, [&](const Edge& e) { return is_behind(e.apex); });
  }
  return true;
}

}  // namespace touchstone
