// Splits a mesh into closed and open parts, and measures winding numbers and distances.
#include "harness/geometry/mesh_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "harness/geometry/mesh_mass.h"

namespace touchstone::geometry {
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
