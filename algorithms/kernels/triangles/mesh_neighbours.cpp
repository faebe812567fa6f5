// Steps: 1. Give equal vertices one number, and list the triangles at each.
//        2. To ask about a point, tell by its weights whether it is in a triangle's face, on an edge or at a
//           vertex, and look at the triangles that share that.
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
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t place : places_of(t)) at_.emplace_back(place, t);
  }
  std::ranges::sort(at_);
  const auto repeated = std::ranges::unique(at_);
  at_.erase(repeated.begin(), repeated.end());
}

MeshNeighbours::Places MeshNeighbours::places_of(std::uint32_t triangle) const {
  Places places;
  for (std::size_t k = 0; k < 3; ++k) places[k] = place_of_[mesh_.triangles[triangle][k]];
  return places;
}

template <class Visit>
bool MeshNeighbours::all_around(std::uint32_t triangle, const Pose& pose, const Vec3d& point,
                                const Visit& visit) const {
  const Places places = places_of(triangle);
  std::array<Vec3d, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = pose(mesh_.vertices[places[k]]);
  const Vec3d weights = weights_of(corner, point);
  Places feature;
  std::size_t corners = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(weights[static_cast<int>(k)] <= least_weight)) feature[corners++] = places[k];
  }
  if (corners == 0 || corners == 3) return visit(triangle);
  for (const auto& [place, other] : std::ranges::equal_range(
           at_, feature[0], {}, &std::pair<std::uint32_t, std::uint32_t>::first)) {
    const bool shares = corners == 1 || std::ranges::count(places_of(other), feature[1]) > 0;
    if (shares && !visit(other)) return false;
  }
  return true;
}

bool MeshNeighbours::supports(std::uint32_t triangle, const Pose& pose, const Vec3d& point,
                              const Vec3d& normal) const {
  const auto is_behind = [&](std::uint32_t place) {
    const Vec3d way = pose(mesh_.vertices[place]) - point;
    return !(normal.dot(way) > slack * way.norm());
  };
  const auto is_whole_behind = [&](std::uint32_t other) {
    return std::ranges::all_of(places_of(other), is_behind);
  };
  return is_whole_behind(triangle) && all_around(triangle, pose, point, is_whole_behind);
}

MeshNeighbours::Face MeshNeighbours::nearest_face(std::uint32_t triangle, const Pose& pose,
                                                  const Vec3d& point, const Vec3d& normal,
                                                  const Vec3d& from) const {
  Face best{Vec3d::Zero(), Vec3d::Zero()};
  double nearest = -2;
  all_around(triangle, pose, point, [&](std::uint32_t other) {
    const Places places = places_of(other);
    const Vec3d corner = pose(mesh_.vertices[places[0]]);
    const Vec3d across =
        (pose(mesh_.vertices[places[1]]) - corner).cross(pose(mesh_.vertices[places[2]]) - corner);
    const double area = across.norm();
    if (!(area > 0)) return true;
    const Vec3d up = across / (across.dot(from - corner) >= 0 ? area : -area);
    const double cosine = up.dot(normal);
    if (cosine > nearest) {
      nearest = cosine;
      best = {up, corner};
    }
    return true;
  });
  return best;
}

}  // namespace touchstone
