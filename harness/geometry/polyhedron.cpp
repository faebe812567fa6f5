// Clips convex polyhedra by planes, splits faces into triangles, and cuts closed meshes into closed
// ones.
#include "harness/geometry/polyhedron.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/mesh_solid.h"

namespace touchstone::geometry {
namespace {

// Sorts points by their angle around their mean, seen from the normal's tip.
void sort_around(std::vector<Vec3d>& points, const Vec3d& normal) {
  Vec3d mean = Vec3d::Zero();
  for (const Vec3d& p : points) mean += p / static_cast<double>(points.size());
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3d u = normal.cross(Vec3d::Unit(least)).normalized();
  const Vec3d v = normal.normalized().cross(u);
  std::vector<std::pair<double, Vec3d>> keyed;
  for (const Vec3d& p : points) keyed.emplace_back(std::atan2(v.dot(p - mean), u.dot(p - mean)), p);
  std::sort(keyed.begin(), keyed.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = keyed[i].second;
}

void remove_equal(std::vector<Vec3d>& points) {
  const auto key = [](const Vec3d& p) { return std::array{p.x(), p.y(), p.z()}; };
  std::sort(points.begin(), points.end(),
            [&](const Vec3d& a, const Vec3d& b) { return key(a) < key(b); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

// The corner whose fan has the widest narrowest triangle, since planes of slivers are only
// rounding.
std::size_t best_apex(const std::vector<Vec3d>& p) {
  const std::size_t n = p.size();
  std::size_t best = 0;
  double widest = -1;
  for (std::size_t apex = 0; n > 3 && apex < n; ++apex) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const Vec3d u = p[(apex + i) % n] - p[apex], v = p[(apex + i + 1) % n] - p[apex];
      thinnest = std::min(thinnest, u.cross(v).norm() / (u.norm() * v.norm()));
    }
    if (!(thinnest > widest)) continue;
    widest = thinnest;
    best = apex;
  }
  return best;
}

}  // namespace

Polyhedron Polyhedron::box(const Vec3d& low, const Vec3d& high) {
  const auto corner = [&](int i) {
    return Vec3d(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                 i & 4 ? high.z() : low.z());
  };
  Polyhedron result;
  constexpr int loops[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& loop : loops) {
    result.faces_.push_back({corner(loop[0]), corner(loop[1]), corner(loop[2]), corner(loop[3])});
  }
  return result;
}

Polyhedron Polyhedron::of(const Hull& hull) {
  Polyhedron result;
  for (const Hull::Face& face : hull.faces) {
    std::vector<Vec3d> polygon;
    for (std::uint32_t v : face.loop) polygon.push_back(hull.vertices[v]);
    result.faces_.push_back(std::move(polygon));
  }
  return result;
}

void Polyhedron::clip(const Plane& plane) {
  const auto beyond = [&](const Vec3d& p) { return plane.normal.dot(p) - plane.offset; };
  std::vector<std::vector<Vec3d>> kept;
  std::vector<Vec3d> rim;
  bool cut = false;
  for (std::vector<Vec3d>& polygon : faces_) {
    std::vector<double> height;
    for (const Vec3d& p : polygon) height.push_back(beyond(p));
    std::vector<Vec3d> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t j = (i + 1) % polygon.size();
      if (height[i] <= 0) left.push_back(polygon[i]);
      if (height[i] == 0) rim.push_back(polygon[i]);
      if ((height[i] > 0) == (height[j] > 0)) continue;
      cut = true;
      // The intersection is computed from the inside outward, so that both faces of an edge get the
      // same bits.
      const auto [in, out] = height[i] > 0 ? std::pair(j, i) : std::pair(i, j);
      const double t = height[in] / (height[in] - height[out]);
      left.push_back(polygon[in] + t * (polygon[out] - polygon[in]));
      rim.push_back(left.back());
    }
    cut = cut || left.empty();
    if (left.size() >= 3) kept.push_back(std::move(left));
  }
  if (!cut) return;
  faces_ = std::move(kept);
  remove_equal(rim);
  if (rim.size() < 3) return;
  sort_around(rim, plane.normal);
  faces_.push_back(std::move(rim));
}

double Polyhedron::volume() const {
  if (faces_.empty()) return 0;
  const Vec3d origin = faces_.front().front();
  double six = 0;
  for (const std::vector<Vec3d>& f : faces_) {
    for (std::size_t i = 1; i + 1 < f.size(); ++i) {
      six += (f[0] - origin).dot((f[i] - origin).cross(f[i + 1] - origin));
    }
  }
  return std::max(0.0, six / 6);
}

std::vector<Vec3d> Polyhedron::corners(double tolerance) const {
  std::vector<Vec3d> result;
  for (const std::vector<Vec3d>& face : faces_) {
    for (const Vec3d& p : face) {
      const bool known = std::any_of(result.begin(), result.end(), [&](const Vec3d& q) {
        return (p - q).cwiseAbs().maxCoeff() <= tolerance;
      });
      if (!known) result.push_back(p);
    }
  }
  return result;
}

Polyhedron intersection(const Vec3d& low, const Vec3d& high, std::span<const Plane> planes) {
  Polyhedron result = Polyhedron::box(low, high);
  for (const Plane& plane : planes) result.clip(plane);
  return result;
}

std::vector<Triangle> triangles_of(const Hull& hull) {
  std::vector<Triangle> result;
  const auto fan = [&](const std::vector<Vec3d>& p) {
    const std::size_t apex = best_apex(p), n = p.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      result.push_back({p[apex], p[(apex + i) % n], p[(apex + i + 1) % n]});
    }
  };
  if (hull.dimension == 3) {
    for (const Hull::Face& face : hull.faces) {
      std::vector<Vec3d> polygon;
      for (std::uint32_t v : face.loop) polygon.push_back(hull.vertices[v]);
      fan(polygon);
    }
    return result;
  }
  std::vector<Vec3d> corners = make_reduced_hull(hull.vertices)->vertices;
  if (hull.dimension < 2 || corners.size() < 3) {
    return {{corners.front(), corners.back(), corners.back()}};
  }
  // The normal is that of the largest triangle with a common first corner.
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3d n = (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
    if (n.norm() > normal.norm()) normal = n;
  }
  sort_around(corners, normal);
  fan(corners);
  return result;
}

double volume_of(std::span<const Triangle> triangles) {
  if (triangles.empty()) return 0;
  const Vec3d origin = triangles.front().a;
  double six = 0;
  for (const Triangle& t : triangles) {
    six += (t.a - origin).dot((t.b - origin).cross(t.c - origin));
  }
  return six / 6;
}

namespace {

// One side of a cut, which is closed at the end.
class Side {
 public:
  explicit Side(const Mesh& mesh) { half_.vertices = mesh.vertices; }

  std::uint32_t add_point(const Vec3d& p) {
    half_.vertices.push_back(p);
    return static_cast<std::uint32_t>(half_.vertices.size() - 1);
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    half_.triangles.push_back({a, b, c});
  }
  void add_rim(std::uint32_t from, std::uint32_t to) { rim_.push_back({from, to}); }

  // Closes each loop of the rim by triangles to its centre.
  std::vector<Mesh> closed() {
    std::map<std::uint32_t, std::uint32_t> parent;
    const auto root = [&](std::uint32_t v) {
      parent.try_emplace(v, v);
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (const auto& [from, to] : rim_) parent[root(from)] = root(to);
    std::map<std::uint32_t, std::pair<Vec3d, double>> sums;
    for (const auto& [from, to] : rim_) {
      auto& [sum, count] = sums.try_emplace(root(from), Vec3d::Zero(), 0).first->second;
      sum += half_.vertices[from] + half_.vertices[to];
      count += 2;
    }
    std::map<std::uint32_t, std::uint32_t> middles;
    for (const auto& [loop, sum] : sums) middles[loop] = add_point(sum.first / sum.second);
    for (const auto& [from, to] : rim_) add(to, from, middles[root(from)]);
    return connected_parts(half_);
  }

 private:
  Mesh half_;
  std::vector<std::array<std::uint32_t, 2>> rim_;
};

}  // namespace

std::vector<Mesh> cut(const Mesh& mesh, Plane plane) {
  std::vector<double> height(mesh.vertices.size());
  double size = 0;
  for (const Vec3d& v : mesh.vertices) size = std::max(size, (v - mesh.vertices.front()).norm());
  for (int attempt = 0;; ++attempt) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < height.size(); ++i) {
      height[i] = plane.normal.dot(mesh.vertices[i]) - plane.offset;
      least = std::min(least, std::abs(height[i]));
    }
    if (least > 1e-9 * size) break;
    if (attempt == 8) return {};
    plane.offset += 1e-6 * size * (attempt % 2 == 0 ? attempt + 1 : -attempt - 1);
  }
  Side above(mesh), below(mesh);
  std::map<std::array<std::uint32_t, 2>, std::array<std::uint32_t, 2>> points;
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, is_new] = points.try_emplace({a, b});
    if (is_new) {
      const double t = height[a] / (height[a] - height[b]);
      const Vec3d p = mesh.vertices[a] + t * (mesh.vertices[b] - mesh.vertices[a]);
      at->second = {above.add_point(p), below.add_point(p)};
    }
    return at->second;
  };
  bool crossed = false;
  for (const auto& t : mesh.triangles) {
    std::size_t up = 0;
    for (std::uint32_t v : t) up += height[v] > 0 ? 1 : 0;
    if (up == 3) above.add(t[0], t[1], t[2]);
    if (up == 0) below.add(t[0], t[1], t[2]);
    if (up == 0 || up == 3) continue;
    crossed = true;
    std::size_t lone = 0;
    while ((height[t[lone]] > 0) != (up == 1)) ++lone;
    const std::uint32_t a = t[lone], b = t[(lone + 1) % 3], c = t[(lone + 2) % 3];
    const auto on_ab = crossing(a, b), on_ac = crossing(a, c);
    const std::size_t mine = up == 1 ? 0 : 1, other = 1 - mine;
    Side& side = up == 1 ? above : below;
    Side& opposite = up == 1 ? below : above;
    side.add(a, on_ab[mine], on_ac[mine]);
    side.add_rim(on_ab[mine], on_ac[mine]);
    opposite.add(on_ab[other], b, c);
    opposite.add(on_ab[other], c, on_ac[other]);
    opposite.add_rim(on_ac[other], on_ab[other]);
  }
  if (!crossed) return {};
  std::vector<Mesh> result = above.closed();
  for (Mesh& part : below.closed()) result.push_back(std::move(part));
  return result;
}

}  // namespace touchstone::geometry
