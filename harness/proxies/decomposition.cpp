// Approximate convex decomposition: cuts, joins, and hulls that are proven.
#include "harness/proxies/decomposition.h"

#include <algorithm>
#include <map>
#include <optional>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/error.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/proxies/fits.h"
#include "harness/proxies/local_body.h"

namespace touchstone::proxies {
namespace {

constexpr int most_parts = 64;
constexpr double enough = 0.01;        // share of the body's volume
constexpr double worth_a_part = 1e-4;  // share of the body's volume
constexpr std::size_t neighbours = 8;  // number of nearest pieces with which joining is tried

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
      at->second = price_of_joining(*live_[i], *live_[j]);
    }
  }

  std::vector<std::optional<Piece>> live_;
  std::size_t count_;
  double volume_;
  std::map<std::pair<std::size_t, std::size_t>, double> prices_;
};

// The box of the least volume that is found around points that Qhull takes for flat.
Part thin_box(const std::vector<Vec3d>& points) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_hull(points);
  const LocalBody sliver(shape, nullptr);
  return sliver.placed(outer_oriented_box(sliver));
}

Part part_around(const LocalBody& body, const Piece& piece) {
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
  std::optional<Shape> hull = hull_that_holds(grown, sturdy_hull(piece.mesh.vertices)->vertices);
  return hull ? Part{std::move(*hull), {}} : thin_box(grown.points);
}

}  // namespace

std::vector<Part> decompose(const LocalBody& body, int most) {
  const Mat3d axes = fitting_axes(body);
  std::vector<Piece> pieces;
  std::vector<geometry::Mesh> closed;
  double signed_volume = 0, volume = 0;
  for (geometry::MeshPiece& piece : geometry::pieces_of(body.mesh)) {
    if (piece.closed) {
      signed_volume += geometry::volume_of(geometry::triangles_of(piece.mesh));
      closed.push_back(std::move(piece.mesh));
    } else {
      pieces.push_back(measured(std::move(piece.mesh), 0, true));
      volume += pieces.back().hull_volume;
    }
  }
  const double sign = signed_volume < 0 ? -1 : 1;
  for (geometry::Mesh& mesh : with_cavities(std::move(closed), sign)) {
    pieces.push_back(measured(std::move(mesh), 0, false));
    volume += pieces.back().volume;
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
    std::vector<Piece> parts = best_cut(*worst, axes, sign);
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
