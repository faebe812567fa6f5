// Measures pieces, joins them, finds their cavities, and tries planes: by one cut, and where that
// gains little by two.
#include "harness/proxies/decomposition.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/mesh_solid.h"
#include "harness/geometry/polyhedron.h"

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

namespace {

constexpr std::size_t concave_edges = 12;
constexpr double enough_gain = 1.0 / 3;   // share of the concavity
constexpr double least_gain = 1e-6;       // share of the hull's volume
constexpr std::size_t tried_further = 3;  // cuts that are followed by another, of the best

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

// The directions of the greatest, middle and least spread of the surface.
Mat3d principal_axes(const geometry::Mesh& mesh) {
  Vec3d sum = Vec3d::Zero();
  Mat3d squares = Mat3d::Zero();
  double area = 0;
  const Vec3d from = mesh.vertices.front();
  for (const geometry::Triangle& t : geometry::triangles_of(mesh)) {
    const Vec3d middle = (t.a + t.b + t.c) / 3 - from;
    const double here = t.normal().norm();
    area += here;
    sum += here * middle;
    squares += here * middle * middle.transpose();
  }
  if (!(area > 0)) return Mat3d::Identity();
  const Vec3d mean = sum / area;
  return Eigen::SelfAdjointEigenSolver<Mat3d>(squares / area - mean * mean.transpose())
      .eigenvectors();
}

// Adds planes that cut the piece's extent along an axis into equal shares.
void add_planes(const geometry::Mesh& mesh, const Vec3d& axis, int shares,
                std::vector<geometry::Plane>& planes) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3d& v : mesh.vertices) {
    low = std::min(low, axis.dot(v));
    high = std::max(high, axis.dot(v));
  }
  for (int i = 1; i < shares; ++i) planes.push_back({axis, low + (high - low) * i / shares});
}

struct Cut {
  std::vector<Piece> parts;
  double sum = 0;        // of the hulls' volumes
  bool central = false;  // through the centre of mass
};

std::vector<Cut> cuts_of(const Piece& piece, const Mat3d& axes, double sign) {
  const geometry::Mesh& mesh = piece.mesh;
  const Mat3d own = principal_axes(mesh);
  const Vec3d centre = geometry::centre_of_mass(mesh);
  std::vector<geometry::Plane> planes;
  for (int k = 0; k < 3; ++k) planes.push_back({own.col(k), own.col(k).dot(centre)});
  const std::size_t central = planes.size();
  for (int k = 0; k < 3; ++k) {
    add_planes(mesh, axes.col(k), 8, planes);
    add_planes(mesh, own.col(k), 4, planes);
  }
  for (const geometry::Plane& plane : concave_planes(mesh)) planes.push_back(plane);
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Cut cut;
    cut.central = i < central;
    for (geometry::Mesh& part : with_cavities(geometry::cut(mesh, planes[i]), sign)) {
      cut.parts.push_back(measured(std::move(part), piece.cuts + 1, false));
      cut.sum += cut.parts.back().hull_volume;
    }
    if (!cut.parts.empty()) cuts.push_back(std::move(cut));
  }
  std::stable_sort(cuts.begin(), cuts.end(),
                   [](const Cut& a, const Cut& b) { return a.sum < b.sum; });
  return cuts;
}

// The volume of the hulls if each part is cut once more where that helps.
double sum_after_another(const Cut& cut, const Mat3d& axes, double sign) {
  double sum = 0;
  for (const Piece& part : cut.parts) {
    const std::vector<Cut> further = cuts_of(part, axes, sign);
    sum += further.empty() ? part.hull_volume : std::min(part.hull_volume, further.front().sum);
  }
  return sum;
}

}  // namespace

std::vector<Piece> best_cut(const Piece& piece, const Mat3d& axes, double sign) {
  std::vector<Cut> cuts = cuts_of(piece, axes, sign);
  if (cuts.empty()) return {};
  Cut* best = &cuts.front();
  double least = best->sum;
  if (piece.hull_volume - least < enough_gain * piece.concavity()) {
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      if (i >= tried_further && !cuts[i].central) continue;
      const double after = sum_after_another(cuts[i], axes, sign);
      if (!(after < least)) continue;
      least = after;
      best = &cuts[i];
    }
  }
  if (!(least < (1 - least_gain) * piece.hull_volume)) return {};
  return std::move(best->parts);
}

}  // namespace touchstone::proxies
