// Draws rays and points.
#include "harness/families/aimed_queries.h"

#include <cmath>
#include <limits>

#include "harness/families/meshes.h"

namespace touchstone::families {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

struct AimedTriangle {
  Vec3d a, b, c;

  AimedTriangle(const TriangleMesh& mesh, std::size_t triangle)
      : a(mesh.vertices[mesh.triangles[triangle][0]]),
        b(mesh.vertices[mesh.triangles[triangle][1]]),
        c(mesh.vertices[mesh.triangles[triangle][2]]) {}
  Vec3d middle() const { return (a + b) / 2; }
  Vec3d inside() const { return (a + b + 2 * c) / 4; }
  Vec3d any(Draws& draws) const {
    const int which = draws.below(3);
    return which == 0 ? a : which == 1 ? middle() : inside();
  }
};

Ray along_axis(const Vec3d& target, Draws& draws) {
  Vec3d along = draws.below(2) == 0 ? Vec3d::Zero() : Vec3d(-Vec3d::Zero());
  along[draws.below(3)] = draws.below(2) == 0 ? 1 : -0.5;
  return draws.below(2) == 0 ? Ray{target - 4 * along, along, inf} : Ray{target, along, 1};
}

Ray along_edge(const AimedTriangle& t, Draws& draws) {
  switch (draws.below(3)) {
    case 0: return {t.a - (t.b - t.a), t.b - t.a, inf};
    case 1: return {t.b, t.a - t.b, inf};
    default: return {t.middle(), t.b - t.a, 0.5};
  }
}

Ray in_plane(const AimedTriangle& t, Draws& draws) {
  const Vec3d u = t.b - t.a, v = t.c - t.a;
  switch (draws.below(4)) {
    case 0: return {t.a - u - v, u * 2 + v, inf};
    case 1: return {t.inside(), u - v, inf};
    case 2: return {t.a + 3 * u + v, -u, inf};
    default: return {t.b + (t.c - t.b) / 4 - 2 * v, v, 1.75};
  }
}

Ray from_away(double distance, const AimedTriangle& t, Draws& draws) {
  const Vec3d target = t.any(draws), far = target + distance * on_grid(draws.direction());
  return {far, target - far, inf};
}

Ray any_ray(const TriangleMesh& mesh, Draws& draws) {
  Ray ray{draws.vector(6), draws.direction(), draws.uniform(0, 20)};
  if (mesh.vertices.empty()) return ray;
  const int number = draws.below(static_cast<int>(mesh.vertices.size()));
  const Vec3d& at = mesh.vertices[static_cast<std::size_t>(number)];
  ray.origin += at;
  if (draws.below(2) == 0) ray.direction = at + draws.vector(0.5) - ray.origin;
  return ray;
}

Ray at_triangle(RayAim aim, const AimedTriangle& t, Draws& draws) {
  const Vec3d around = t.a + on_grid(draws.vector(8));
  const auto at = [&](const Vec3d& target) { return Ray{around, target - around, inf}; };
  switch (aim) {
    case RayAim::vertex: return at(t.a);
    case RayAim::edge: return at(t.middle());
    case RayAim::face: return at(t.inside());
    case RayAim::to_the_end: {
      Ray ray = at(t.any(draws));
      ray.t_max = draws.below(2) == 0 ? 1 : std::nextafter(1.0, 0);
      return ray;
    }
    case RayAim::from_surface: {
      const Vec3d target = t.any(draws);
      if (draws.below(2) == 0) return {target, on_grid(draws.vector(2)), inf};
      return {target, target - around, 0};
    }
    case RayAim::far: return from_away(1e6, t, draws);
    case RayAim::axis: return along_axis(t.any(draws), draws);
    case RayAim::axis_plane: {
      Vec3d slant = on_grid(draws.vector(2));
      slant[draws.below(3)] = 0;
      return {t.any(draws) - 2 * slant, slant, inf};
    }
    case RayAim::along_edge: return along_edge(t, draws);
    default: return in_plane(t, draws);
  }
}

}  // namespace

std::string_view to_string(RayAim aim) {
  constexpr std::array<std::string_view, all_ray_aims.size()> names = {
      "vertex", "edge",       "face",       "to-the-end", "from-surface", "far",
      "axis",   "axis-plane", "along-edge", "in-plane",   "random"};
  return names[static_cast<std::size_t>(aim)];
}

Ray aimed_ray(RayAim aim, const TriangleMesh& mesh, std::size_t triangle, Draws& draws) {
  if (aim == RayAim::random || mesh.triangles.empty()) return any_ray(mesh, draws);
  const AimedTriangle corners(mesh, triangle);
  // A degenerate triangle has no direction along it.
  for (int tries = 0; tries < 4; ++tries) {
    const Ray ray = at_triangle(aim, corners, draws);
    if (!ray.direction.isZero(0)) return ray;
  }
  return any_ray(mesh, draws);
}

Ray ray_from(double distance, const TriangleMesh& mesh, std::size_t triangle, Draws& draws) {
  if (mesh.triangles.empty()) return any_ray(mesh, draws);
  const Ray ray = from_away(distance, AimedTriangle(mesh, triangle), draws);
  return ray.direction.isZero(0) ? any_ray(mesh, draws) : ray;
}

std::vector<Ray> aimed_rays(const TriangleMesh& mesh, double share, std::uint64_t seed) {
  RandomDraws draws(seed);
  std::vector<Ray> rays;
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    if (draws.uniform(0, 1) >= share) continue;
    for (const RayAim aim : all_ray_aims) {
      for (int i = 0; i < 4 && aim != RayAim::random; ++i) {
        rays.push_back(aimed_ray(aim, mesh, triangle, draws));
      }
    }
  }
  return rays;
}

std::vector<Ray> random_rays(const TriangleMesh& mesh, int count, std::uint64_t seed) {
  RandomDraws draws(seed);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) rays.push_back(any_ray(mesh, draws));
  return rays;
}

std::vector<Ray> rays_in_sixteens(const TriangleMesh& mesh, int count, std::uint64_t seed) {
  RandomDraws draws(seed);
  std::vector<Ray> rays;
  for (int i = 0; i < count && !mesh.triangles.empty(); ++i) {
    const int first = draws.below(static_cast<int>(mesh.triangles.size()));
    const auto triangle = [&](int next) {
      return AimedTriangle(mesh, static_cast<std::size_t>(first + next) % mesh.triangles.size());
    };
    const Vec3d way = on_grid(Vec3d(24 * draws.direction()));
    const Vec3d eye = triangle(0).a + way;
    for (int k = 0; k < 16; ++k) {
      const AimedTriangle t = triangle(k / 4);
      const std::array targets = {t.a, t.middle(), t.inside(), Vec3d(t.b + (t.b - t.a) / 8)};
      const Vec3d& target = targets[static_cast<std::size_t>(k % 4)];
      const Vec3d from = i % 2 == 0 ? eye : Vec3d(target + way);
      if (from == target) continue;
      rays.push_back({from, target - from, i % 5 == 0 ? 1 : inf});
    }
  }
  return rays;
}

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
