// Splits each triangle at the plane and closes both sides.
#include "harness/geometry/mesh_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "harness/geometry/mesh_mass.h"

namespace touchstone::geometry {
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
