// Measures pieces, joins them, and finds their cavities.
#include "harness/proxies/parts/piece.h"

#include <algorithm>
#include <cmath>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/mesh_solid.h"

namespace touchstone::proxies {
namespace {

void measure_hull(const std::vector<Vec3d>& points, Piece& piece) {
  const std::shared_ptr<const Hull> hull = sturdy_hull(points);
  piece.corners = hull->vertices;
  piece.hull_volume = hull->faces.empty() ? 0 : geometry::volume_of(geometry::triangles_of(*hull));
  for (const Vec3d& v : piece.corners) {
    piece.middle += v / static_cast<double>(piece.corners.size());
  }
}

std::vector<Vec3d> both(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  std::vector<Vec3d> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

void append(const geometry::Mesh& more, geometry::Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices = both(mesh.vertices, more.vertices);
  for (const auto& [a, b, c] : more.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

struct Extent {
  explicit Extent(const geometry::Mesh& mesh)
      : low(mesh.vertices.front()), high(low), volume(volume_of(geometry::triangles_of(mesh))) {
    for (const Vec3d& v : mesh.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  // Up to the rounding of cuts.
  bool holds(const Extent& other) const {
    const double room = 1e-9 * (high - low).norm();
    return ((other.low - low).array() >= -room).all() &&
           ((high - other.high).array() >= -room).all();
  }

  Vec3d low, high;
  double volume;
};

}  // namespace

std::shared_ptr<const Hull> sturdy_hull(const std::vector<Vec3d>& points) {
  std::shared_ptr<const Hull> hull = make_reduced_hull(points);
  for (double grid = 0x1p-30; grid < 0x1p-11 && hull->dimension == 3 && hull->faces.empty();
       grid *= 16) {
    std::vector<Vec3d> rounded;
    for (const Vec3d& p : points) rounded.emplace_back((p / grid).array().round() * grid);
    hull = make_reduced_hull(rounded);
  }
  return hull;
}

Piece measured(geometry::Mesh mesh, int cuts, bool whole) {
  Piece piece;
  piece.mesh = std::move(mesh);
  piece.cuts = cuts;
  piece.whole = whole;
  measure_hull(piece.mesh.vertices, piece);
  piece.volume = std::abs(geometry::volume_of(geometry::triangles_of(piece.mesh)));
  return piece;
}

Piece joined(const Piece& a, const Piece& b) {
  Piece piece;
  piece.mesh.vertices = both(a.mesh.vertices, b.mesh.vertices);
  piece.volume = a.volume + b.volume;
  piece.cuts = std::max(a.cuts, b.cuts);
  piece.whole = true;
  measure_hull(both(a.corners, b.corners), piece);
  return piece;
}

double price_of_joining(const Piece& a, const Piece& b) {
  Piece whole;
  measure_hull(both(a.corners, b.corners), whole);
  return whole.hull_volume - a.hull_volume - b.hull_volume;
}

std::vector<geometry::Mesh> with_cavities(std::vector<geometry::Mesh> closed, double sign) {
  const std::vector<Extent> extents(closed.begin(), closed.end());
  std::vector<geometry::Mesh> result;
  std::vector<std::size_t> place(closed.size(), closed.size());  // of each solid in the result
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (sign * extents[i].volume < 0) continue;
    place[i] = result.size();
    result.push_back(std::move(closed[i]));
  }
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (place[i] != closed.size()) continue;
    std::size_t around = closed.size();
    for (std::size_t j = 0; j < closed.size(); ++j) {
      if (place[j] == closed.size() || !extents[j].holds(extents[i])) continue;
      if (around == closed.size() ||
          std::abs(extents[j].volume) < std::abs(extents[around].volume)) {
        around = j;
      }
    }
    if (around == closed.size()) {
      result.push_back(std::move(closed[i]));
    } else {
      append(closed[i], result[place[around]]);
    }
  }
  return result;
}

}  // namespace touchstone::proxies
