// Approximate convex decomposition: greedy cuts, joins, and hulls that are proven.
#include "harness/proxies/decomposition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "harness/geometry/mesh_cut.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/proxies/certainty.h"
#include "harness/proxies/outer_fits.h"

namespace touchstone::proxies {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_parts = 64;
constexpr double enough = 0.01;        // share of the body's volume
constexpr double worth_a_part = 1e-4;  // share of the body's volume
constexpr std::size_t concave_edges = 12;
constexpr std::size_t neighbours = 8;  // number of nearest pieces with which joining is tried

struct Piece {
  geometry::Mesh mesh;         // empty if joined from several pieces
  std::vector<Vec3d> corners;  // of its hull
  Vec3d middle = Vec3d::Zero();
  double hull_volume = 0, volume = 0;
  int cuts = 0;        // number of cuts that its points may have come from
  bool whole = false;  // must not be cut

  double concavity() const { return whole ? 0 : hull_volume - volume; }
};

void measure_hull(const std::vector<Vec3d>& points, Piece& piece) {
  const std::shared_ptr<const Hull> hull = make_reduced_hull(points);
  piece.corners = hull->vertices;
  piece.hull_volume = hull->faces.empty() ? 0 : geometry::volume_of(geometry::triangles_of(*hull));
  for (const Vec3d& v : piece.corners) {
    piece.middle += v / static_cast<double>(piece.corners.size());
  }
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

// The planes of the faces beside the most concave edges, weighted by length.
std::vector<geometry::Plane> concave_planes(const geometry::Mesh& mesh) {
  const std::vector<geometry::Triangle> triangles = geometry::triangles_of(mesh);
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
      const double bend = -m.cross(n).dot(edge);  // sine times length, > 0 if concave
      if (bend > 1e-3 * edge.norm()) edges.push_back({bend, {t, other->second}});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  if (edges.size() > concave_edges) edges.resize(concave_edges);
  std::vector<geometry::Plane> planes;
  for (const auto& [bend, pair] : edges) {
    for (std::size_t t : pair) {
      const Vec3d n = triangles[t].normal().normalized();
      const geometry::Plane plane{n, n.dot(triangles[t].a)};
      const bool known = std::any_of(planes.begin(), planes.end(), [&](const geometry::Plane& p) {
        return std::abs(p.normal.dot(n)) > 1 - 1e-9 &&
               std::abs(std::abs(p.offset) - std::abs(plane.offset)) < 1e-9;
      });
      if (n.allFinite() && !known) planes.push_back(plane);
    }
  }
  return planes;
}

std::vector<geometry::Plane> candidates(const geometry::Mesh& mesh, const Mat3d& axes) {
  std::vector<geometry::Plane> planes = concave_planes(mesh);
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
  for (const geometry::Plane& plane : candidates(piece.mesh, axes)) {
    std::vector<Piece> tried;
    double sum = 0;
    for (geometry::Mesh& part : geometry::cut(piece.mesh, plane)) {
      tried.push_back(measured(std::move(part), piece.cuts + 1, false));
      sum += tried.back().hull_volume;
    }
    if (tried.empty() || !(sum < least)) continue;
    least = sum;
    best = std::move(tried);
  }
  return best;
}

std::vector<Vec3d> both(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  std::vector<Vec3d> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
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

// Joins neighbouring pieces: always the pair that adds least volume, while there are too many
// pieces or the pair adds almost nothing.
class Joiner {
 public:
  Joiner(std::vector<Piece> pieces, double volume)
      : live_(pieces.begin(), pieces.end()), count_(pieces.size()), volume_(volume) {}

  std::vector<Piece> join(std::size_t most) {
    price_all();
    while (count_ > 1) {
      if (prices_.empty()) price_all();
      const auto least =
          std::min_element(prices_.begin(), prices_.end(),
                           [](const auto& a, const auto& b) { return a.second < b.second; });
      if (count_ <= most && least->second > worth_a_part * volume_) break;
      const auto [grown, gone] = least->first;
      live_[grown] = joined(*live_[grown], *live_[gone]);
      live_[gone].reset();
      --count_;
      std::erase_if(prices_, [i = grown, j = gone](const auto& p) {
        const auto& [a, b] = p.first;
        return a == i || b == i || a == j || b == j;
      });
      price(grown);
    }
    std::vector<Piece> result;
    for (std::optional<Piece>& piece : live_) {
      if (piece) result.push_back(std::move(*piece));
    }
    return result;
  }

 private:
  void price_all() {
    for (std::size_t i = 0; i < live_.size(); ++i) {
      if (live_[i]) price(i);
    }
  }
  // Prices the joins with the nearest pieces.
  void price(std::size_t i) {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t j = 0; j < live_.size(); ++j) {
      if (j != i && live_[j]) near.emplace_back((live_[j]->middle - live_[i]->middle).norm(), j);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > neighbours) near.resize(neighbours);
    for (const auto& [distance, j] : near) {
      const auto [at, is_new] = prices_.try_emplace({std::min(i, j), std::max(i, j)});
      if (!is_new) continue;
      Piece whole;
      measure_hull(both(live_[i]->corners, live_[j]->corners), whole);
      at->second = whole.hull_volume - live_[i]->hull_volume - live_[j]->hull_volume;
    }
  }

  std::vector<std::optional<Piece>> live_;
  std::size_t count_;
  double volume_;
  std::map<std::pair<std::size_t, std::size_t>, double> prices_;
};

Part part_around(const LocalBody& body, const Piece& piece) {
  Part part;
  part.shape.kind = ShapeKind::hull;
  // A rounded point is off by less than 8 units of its coordinates. Six points around it contain a
  // ball of that radius.
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
    part.shape.hull = make_hull(grown.points);  // for a thin piece all points are vertices
  }
  return part;
}

}  // namespace

std::vector<Part> decompose(const LocalBody& body, int most) {
  const Mat3d axes = fitting_axes(body);
  std::vector<Piece> pieces;
  double volume = 0;
  for (geometry::MeshPiece& piece : geometry::pieces_of(body.mesh)) {
    pieces.push_back(measured(std::move(piece.mesh), 0, !piece.closed));
    volume += pieces.back().whole ? pieces.back().hull_volume : pieces.back().volume;
  }
  if (pieces.empty())
    throw base::InputError("the mesh has no triangles, so no parts; expected some");
  // The number of pieces exceeds the limit at first, because joining makes up for cuts that were
  // not the best.
  const std::size_t limit =
      most > 0 ? static_cast<std::size_t>(most) : std::max(pieces.size(), std::size_t{most_parts});
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
  pieces = Joiner(std::move(pieces), volume).join(limit);
  std::vector<Part> parts;
  for (const Piece& piece : pieces) parts.push_back(part_around(body, piece));
  return parts;
}

}  // namespace touchstone::proxies
