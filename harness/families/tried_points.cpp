// Draws points.
#include "harness/families/tried_points.h"

namespace touchstone::families {
namespace {

double distance_of(PointPlace place) {
  switch (place) {
    case PointPlace::off_1e_3: return 1e-3;
    case PointPlace::off_1e_5: return 1e-5;
    case PointPlace::off_1e_7: return 1e-7;
    case PointPlace::off_1e_11: return 1e-11;
    case PointPlace::off_1e_15: return 1e-15;
    default: return 0;
  }
}

// A vertex, the middle of an edge or a point of the face.
Vec3d point_of(const TriangleMesh& mesh, std::size_t triangle, Draws& draws) {
  const auto& [i, j, k] = mesh.triangles[triangle];
  const Vec3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
  const int which = draws.below(3);
  return which == 0 ? a : which == 1 ? Vec3d((a + b) / 2) : Vec3d((a + b + 2 * c) / 4);
}

}  // namespace

std::string_view to_string(PointPlace place) {
  constexpr std::array<std::string_view, all_point_places.size()> names = {
      "on-surface", "off-1e-3", "off-1e-5",     "off-1e-7", "off-1e-11",
      "off-1e-15",  "in-line",  "from-corners", "around",   "far"};
  return names[static_cast<std::size_t>(place)];
}

Vec3d point_off(double distance, const TriangleMesh& mesh, std::size_t triangle, Draws& draws) {
  if (mesh.triangles.empty()) return draws.vector(4);
  return point_of(mesh, triangle, draws) + distance * draws.direction();
}

Vec3d tried_point(PointPlace place, const TriangleMesh& mesh, std::size_t triangle, Draws& draws) {
  if (mesh.triangles.empty()) return draws.vector(4);
  const auto& [i, j, k] = mesh.triangles[triangle];
  const Vec3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
  Vec3d on = point_of(mesh, triangle, draws);
  switch (place) {
    case PointPlace::in_line: {
      const int kept = draws.below(3);
      const int moved = (kept + 1) % 3;
      on[moved] += draws.uniform(-2, 2);
      if (draws.below(2) == 0) on[(kept + 2) % 3] += draws.uniform(-2, 2);
      return on;
    }
    case PointPlace::from_corners: return {a[0], b[1], c[2]};
    case PointPlace::around: return a + draws.vector(4);
    case PointPlace::far: return 1e6 * draws.direction();
    default: return on + distance_of(place) * draws.direction();
  }
}

std::vector<Vec3d> tried_points(const TriangleMesh& mesh, double share, std::uint64_t seed) {
  RandomDraws draws(seed);
  std::vector<Vec3d> points = {Vec3d::Zero()};
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    if (draws.uniform(0, 1) >= share) continue;
    for (const PointPlace place : all_point_places) {
      for (int i = 0; i < 3; ++i) points.push_back(tried_point(place, mesh, triangle, draws));
    }
  }
  return points;
}

}  // namespace touchstone::families
