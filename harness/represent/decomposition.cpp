#include "harness/represent/decomposition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "harness/error.h"
#include "harness/represent/certainty.h"
#include "harness/represent/mesh_cut.h"
#include "harness/represent/mesh_solid.h"
#include "harness/represent/outer_fits.h"
#include "harness/scene/convex_hull.h"

namespace touchstone {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_parts = 64;
constexpr double enough = 0.01;        // of the body's volume
constexpr double worth_a_part = 1e-4;  // of the body's volume
constexpr std::size_t concave_edges = 12;

struct Piece {
  Mesh mesh;
  double hull_volume = 0, volume = 0;
  int cuts = 0;        // that its points may have come from
  bool whole = false;  // not to be cut

  double concavity() const { return whole ? 0 : hull_volume - volume; }
};

double hull_volume(const std::vector<Vec3d>& points) {
  const std::shared_ptr<const Hull> hull = make_reduced_hull(points);
  return hull->faces.empty() ? 0 : volume_of(triangles_of(*hull));
}

Piece measured(Mesh mesh, int cuts, bool whole) {
  Piece piece{std::move(mesh), 0, 0, cuts, whole};
  piece.hull_volume = hull_volume(piece.mesh.vertices);
  piece.volume = std::abs(volume_of(triangles_of(piece.mesh)));
  return piece;
}

// Planes of the faces beside the concave edges that bend most, weighed by length.
std::vector<Plane> concave_planes(const Mesh& mesh) {
  const std::vector<Triangle> triangles = triangles_of(mesh);
  std::map<std::array<std::uint32_t, 2>, std::size_t> first;
  std::vector<std::pair<double, std::array<std::size_t, 2>>> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      const auto [other, is_new] = first.insert({{std::min(a, b), std::max(a, b)}, t});
      if (is_new) continue;
      const Vec3d m = triangles[t].normal().normalized();
      const Vec3d n = triangles[other->second].normal().normalized();
      const Vec3d edge = mesh.vertices[b] - mesh.vertices[a];
      const double bend = -m.cross(n).dot(edge);  // of the other triangle's direction along it
      if (bend > 1e-3 * edge.norm()) edges.push_back({bend, {t, other->second}});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  if (edges.size() > concave_edges) edges.resize(concave_edges);
  std::vector<Plane> planes;
  for (const auto& [bend, pair] : edges) {
    for (std::size_t t : pair) {
      const Vec3d n = triangles[t].normal().normalized();
      const Plane plane{n, n.dot(triangles[t].a)};
      const bool known = std::any_of(planes.begin(), planes.end(), [&](const Plane& p) {
        return std::abs(p.normal.dot(n)) > 1 - 1e-9 &&
               std::abs(std::abs(p.offset) - std::abs(plane.offset)) < 1e-9;
      });
      if (n.allFinite() && !known) planes.push_back(plane);
    }
  }
  return planes;
}

std::vector<Plane> candidates(const Mesh& mesh, const Mat3d& axes) {
  std::vector<Plane> planes = concave_planes(mesh);
  for (int k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3d& v : mesh.vertices) {
      low = std::min(low, axes.col(k).dot(v));
      high = std::max(high, axes.col(k).dot(v));
    }
    for (int i = 1; i < 8; ++i) planes.push_back({axes.col(k), low + (high - low) * i / 8});
  }
  return planes;
}

std::vector<Piece> best_cut(const Piece& piece, const Mat3d& axes) {
  std::vector<Piece> best;
  double least = piece.hull_volume;
  for (const Plane& plane : candidates(piece.mesh, axes)) {
    std::vector<Piece> tried;
    double sum = 0;
    for (Mesh& part : cut(piece.mesh, plane)) {
      tried.push_back(measured(std::move(part), piece.cuts + 1, false));
      sum += tried.back().hull_volume;
    }
    if (tried.empty() || !(sum < least)) continue;
    least = sum;
    best = std::move(tried);
  }
  return best;
}

Piece joined(const Piece& a, const Piece& b) {
  Mesh mesh = a.mesh;  // of points alone: joined pieces are not cut again
  mesh.triangles.clear();
  mesh.vertices.insert(mesh.vertices.end(), b.mesh.vertices.begin(), b.mesh.vertices.end());
  mesh.vertices = make_reduced_hull(mesh.vertices)->vertices;
  Piece piece{std::move(mesh), 0, a.volume + b.volume, std::max(a.cuts, b.cuts) + 1, true};
  piece.hull_volume = hull_volume(piece.mesh.vertices);
  return piece;
}

// Joins the pair that adds least while there are too many or it adds hardly anything.
void join(std::vector<Piece>& pieces, std::size_t most, double volume) {
  const auto price = [](const Piece& a, const Piece& b) {
    return joined(a, b).hull_volume - a.hull_volume - b.hull_volume;
  };
  std::map<std::pair<std::size_t, std::size_t>, double> prices;
  std::vector<std::optional<Piece>> live(pieces.begin(), pieces.end());
  const auto consider = [&](std::size_t i, std::size_t j) {
    prices[{i, j}] = price(*live[i], *live[j]);
  };
  for (std::size_t i = 0; i < live.size(); ++i) {
    for (std::size_t j = i + 1; j < live.size(); ++j) consider(i, j);
  }
  std::size_t count = pieces.size();
  while (count > 1) {
    const auto least =
        std::min_element(prices.begin(), prices.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (count <= most && least->second > worth_a_part * volume) break;
    const auto [i, j] = least->first;
    live[i] = joined(*live[i], *live[j]);
    live[j].reset();
    --count;
    std::erase_if(prices, [&, gone = j, grown = i](const auto& p) {
      const auto& [a, b] = p.first;
      return a == gone || b == gone || a == grown || b == grown;
    });
    for (std::size_t k = 0; k < live.size(); ++k) {
      if (k != i && live[k]) consider(std::min(i, k), std::max(i, k));
    }
  }
  pieces.clear();
  for (std::optional<Piece>& piece : live) {
    if (piece) pieces.push_back(std::move(*piece));
  }
}

Part part_around(const LocalBody& body, const Piece& piece) {
  Part part;
  part.shape.kind = ShapeKind::hull;
  // A rounded point is off by less than 8 units of its coordinates; six points around each hold a ball.
  const double moved = piece.cuts * 16 * epsilon * (body.size + body.middle.norm());
  LocalBody grown = body;
  grown.points.clear();
  for (const Vec3d& p : piece.mesh.vertices) {
    for (int k = 0; moved > 0 && k < 3; ++k) {
      for (double by : {-2 * moved, 2 * moved}) grown.points.push_back(p + by * Vec3d::Unit(k));
    }
    if (moved == 0) grown.points.push_back(p);
  }
  if (std::optional<Shape> hull = hull_that_holds(grown, piece.mesh.vertices)) {
    part.shape = std::move(*hull);
  } else {
    part.shape.hull = make_hull(grown.points);  // thin: all of the points are its vertices
  }
  return part;
}

}  // namespace

std::vector<Part> decompose(const LocalBody& body, int most) {
  const Mat3d axes = fitting_axes(body);
  std::vector<Piece> pieces;
  double volume = 0;
  for (MeshPiece& piece : pieces_of(body.mesh)) {
    pieces.push_back(measured(std::move(piece.mesh), 0, !piece.closed));
    volume += pieces.back().whole ? pieces.back().hull_volume : pieces.back().volume;
  }
  if (pieces.empty()) throw InputError("the mesh has no triangles, so no parts; expected some");
  const auto limit = static_cast<std::size_t>(most > 0 ? most : most_parts);
  // Somewhat more than asked for, as joining makes up for cuts that were not the best.
  while (pieces.size() < limit + limit / 2) {
    const auto worst = std::max_element(
        pieces.begin(), pieces.end(),
        [](const Piece& a, const Piece& b) { return a.concavity() < b.concavity(); });
    if (!(worst->concavity() > (most > 0 ? 1e-3 : enough) * volume)) break;
    std::vector<Piece> parts = best_cut(*worst, axes);
    if (parts.empty()) {
      worst->whole = true;
      continue;
    }
    pieces.erase(worst);
    std::move(parts.begin(), parts.end(), std::back_inserter(pieces));
  }
  join(pieces, limit, volume);
  std::vector<Part> parts;
  for (const Piece& piece : pieces) parts.push_back(part_around(body, piece));
  return parts;
}

}  // namespace touchstone
