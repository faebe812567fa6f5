// Tries planes, by one cut and where that gains little by two.
#include "harness/proxies/parts/cut_choice.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "harness/geometry/mesh_cut.h"
#include "harness/geometry/mesh_mass.h"
#include "harness/geometry/mesh_solid.h"

namespace touchstone::proxies {
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
