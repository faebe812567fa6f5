// Centre of mass and connected parts. Splits a mesh into closed and open parts, and measures
// winding numbers and distances.
#include "harness/geometry/mesh_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
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

namespace {

Mesh welded(const Mesh& mesh) {
  Mesh result;
  std::map<std::array<double, 3>, std::uint32_t> known;
  const auto index = [&](std::uint32_t v) {
    const Vec3d& p = mesh.vertices[v];
    const auto [at, is_new] =
        known.insert({{p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(result.vertices.size())});
    if (is_new) result.vertices.push_back(p);
    return at->second;
  };
  for (const auto& [i, j, k] : mesh.triangles) {
    const std::array<std::uint32_t, 3> t = {index(i), index(j), index(k)};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.triangles.push_back(t);
  }
  return result;
}

bool is_closed(const Mesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& e) { return e.second == 0; });
}

}  // namespace

std::vector<MeshPiece> pieces_of(const Mesh& mesh) {
  std::vector<MeshPiece> pieces;
  Mesh rest;
  for (Mesh& part : connected_parts(mesh)) {
    if (is_closed(part)) {
      pieces.push_back({std::move(part), true});
      continue;
    }
    const auto first = static_cast<std::uint32_t>(rest.vertices.size());
    rest.vertices.insert(rest.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [a, b, c] : part.triangles) {
      rest.triangles.push_back({first + a, first + b, first + c});
    }
  }
  for (Mesh& part : connected_parts(welded(rest))) {
    const bool closed = is_closed(part);
    pieces.push_back({std::move(part), closed});
  }
  return pieces;
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> result;
  const std::vector<Vec3d>& v = mesh.vertices;
  for (const auto& [i, j, k] : mesh.triangles) result.push_back({v[i], v[j], v[k]});
  return result;
}

double winding_number(const std::vector<Triangle>& surface, const Vec3d& x) {
  double sum = 0;
  for (const Triangle& t : surface) {
    const Vec3d a = t.a - x, b = t.b - x, c = t.c - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

// The region of the triangle's plane that contains x decides (Ericson, "Real-Time Collision
// Detection", 5.1.5).
Vec3d nearest_point(const Triangle& t, const Vec3d& x) {
  const Vec3d ab = t.b - t.a, ac = t.c - t.a, ax = x - t.a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return t.a;
  const Vec3d bx = x - t.b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return t.b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 - d3 > 0 ? Vec3d(t.a + d1 / (d1 - d3) * ab) : t.a;
  const Vec3d cx = x - t.c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return t.c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 - d6 > 0 ? Vec3d(t.a + d2 / (d2 - d6) * ac) : t.a;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double both = (d4 - d3) + (d5 - d6);
    return both > 0 ? Vec3d(t.b + (d4 - d3) / both * (t.c - t.b)) : t.b;
  }
  const double all = va + vb + vc;
  if (!(all > 0)) return t.a;
  return t.a + vb / all * ab + vc / all * ac;
}

Surface::Surface(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  for (const Triangle& t : triangles_) {
    const Vec3d centre = (t.a + t.b + t.c) / 3;
    centres_.push_back(centre);
    radii_.push_back(
        std::max({(t.a - centre).norm(), (t.b - centre).norm(), (t.c - centre).norm()}));
  }
}

double Surface::distance(const Vec3d& x) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const double room = nearest + radii_[i];
    if ((x - centres_[i]).squaredNorm() >= room * room) continue;
    nearest = std::min(nearest, (x - nearest_point(triangles_[i], x)).norm());
  }
  return nearest;
}

std::vector<SurfacePoint> spread_points(const std::vector<Triangle>& surface, std::size_t count) {
  std::vector<SurfacePoint> points;
  double area = 0;
  for (const Triangle& t : surface) area += t.normal().norm();
  // Points are spread evenly over the areas one after another, and by two powers of the plastic
  // number within a triangle.
  double before = 0;
  std::size_t made = 0;
  for (const Triangle& t : surface) {
    const double here = t.normal().norm();
    const Vec3d normal = here > 0 ? Vec3d(t.normal() / here) : Vec3d(Vec3d::Zero());
    for (const Vec3d& corner : {t.a, t.b, t.c}) points.push_back({corner, normal});
    before += here;
    while (area > 0 && made < count &&
           (static_cast<double>(made) + 0.5) / static_cast<double>(count) * area < before) {
      ++made;
      double u = std::fmod(static_cast<double>(made) * 0.7548776662466927, 1);
      double v = std::fmod(static_cast<double>(made) * 0.5698402909980532, 1);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      points.push_back({t.a + u * (t.b - t.a) + v * (t.c - t.a), normal});
    }
  }
  return points;
}

}  // namespace touchstone::geometry
