// Volumes of unions, by intervals along parallel lines.
#include "harness/proxies/union_volume.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone::proxies {
namespace {

constexpr int lattices = 8, lines = 4096;
constexpr int cells = 64;  // per direction, for finding triangles
// A polytope with more planes than this is faster by its triangles.
constexpr std::size_t few_planes = 64;

using Intervals = std::vector<std::pair<double, double>>;

// Sorts and merges the intervals; returns their total length.
double join(Intervals& intervals) {
  std::sort(intervals.begin(), intervals.end());
  Intervals joined;
  for (const auto& [low, high] : intervals) {
    if (!joined.empty() && low <= joined.back().second) {
      joined.back().second = std::max(joined.back().second, high);
    } else {
      joined.emplace_back(low, high);
    }
  }
  intervals = std::move(joined);
  double length = 0;
  for (const auto& [low, high] : intervals) length += high - low;
  return length;
}

double common_length(const Intervals& a, const Intervals& b) {
  double length = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    length += std::max(0.0, std::min(a[i].second, b[j].second) - std::max(a[i].first, b[j].first));
    ++(a[i].second < b[j].second ? i : j);
  }
  return length;
}

// A closed surface, sorted into cells of the plane.
class Columns {
 public:
  Columns(const std::vector<geometry::Triangle>& triangles, const Vec3d& low, const Vec3d& high)
      : triangles_(triangles), low_(low), cells_(cells * cells) {
    width_ = ((high - low) / cells).cwiseMax(1e-300);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      const Vec3d from = a.cwiseMin(b).cwiseMin(c), to = a.cwiseMax(b).cwiseMax(c);
      for (int i = cell(from.x(), 0); i <= cell(to.x(), 0); ++i) {
        for (int j = cell(from.y(), 1); j <= cell(to.y(), 1); ++j) {
          cells_[static_cast<std::size_t>(i * cells + j)].push_back(t);
        }
      }
    }
  }
  // Adds the intervals with a nonzero winding number.
  void add(double x, double y, Intervals& intervals) const {
    std::vector<std::pair<double, int>> crossings;
    for (std::uint32_t t : cells_[static_cast<std::size_t>(cell(x, 0) * cells + cell(y, 1))]) {
      cross(triangles_[t], x, y, crossings);
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    double start = 0;
    for (const auto& [z, turn] : crossings) {
      if (winding == 0) start = z;
      winding += turn;
      if (winding == 0) intervals.emplace_back(start, z);
    }
  }

 private:
  int cell(double x, int axis) const {
    return std::clamp(static_cast<int>((x - low_[axis]) / width_[axis]), 0, cells - 1);
  }
  // The side of the edge on which the line is. Both triangles of an edge get the same bits, and no
  // line is between the two.
  static double side(const Vec3d& p, const Vec3d& q, double x, double y) {
    if (std::array{q.x(), q.y(), q.z()} < std::array{p.x(), p.y(), p.z()}) return -side(q, p, x, y);
    const double s = (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
    return s == 0 ? 1e-300 : s;
  }
  static void cross(const geometry::Triangle& t, double x, double y,
                    std::vector<std::pair<double, int>>& crossings) {
    const double a = side(t.b, t.c, x, y), b = side(t.c, t.a, x, y), c = side(t.a, t.b, x, y);
    if ((a > 0) != (b > 0) || (b > 0) != (c > 0)) return;
    crossings.emplace_back((a * t.a.z() + b * t.b.z() + c * t.c.z()) / (a + b + c), a > 0 ? -1 : 1);
  }

  const std::vector<geometry::Triangle>& triangles_;
  Vec3d low_, width_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace

Overlap overlap_of(const std::vector<PlacedSolid>& body,
                   const std::vector<std::vector<geometry::Triangle>>& closed,
                   const std::vector<PlacedSolid>& parts) {
  Vec3d low = Vec3d::Constant(1e300), high = -low;
  const auto widen = [&](const Vec3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const auto* list : {&body, &parts}) {
    for (const PlacedSolid& solid : *list) {
      widen(solid.low());
      widen(solid.high());
    }
  }
  for (const auto& surface : closed) {
    for (const geometry::Triangle& t : surface) {
      for (const Vec3d& p : {t.a, t.b, t.c}) widen(p);
    }
  }
  std::vector<Columns> columns, of_parts;
  for (const auto& surface : closed) columns.emplace_back(surface, low, high);
  for (const PlacedSolid& solid : body) {
    if (solid.planes().size() > few_planes) columns.emplace_back(solid.surface(), low, high);
  }
  for (const PlacedSolid& solid : parts) {
    if (solid.planes().size() > few_planes) of_parts.emplace_back(solid.surface(), low, high);
  }
  const double area = (high.x() - low.x()) * (high.y() - low.y());
  const auto add_lines = [](const std::vector<PlacedSolid>& solids, double x, double y,
                            Intervals& intervals) {
    for (const PlacedSolid& solid : solids) {
      if (solid.planes().size() > few_planes) continue;
      if (x < solid.low().x() || x > solid.high().x()) continue;
      if (const auto line = solid.along_z(x, y)) intervals.push_back(*line);
    }
  };
  Overlap sum;
  std::vector<double> errors;
  Intervals in_body, in_parts;
  for (int lattice = 0; lattice < lattices; ++lattice) {
    Overlap here;
    for (int i = 0; i < lines; ++i) {
      const double n = lattice * lines + i + 0.5;
      const double x = low.x() + std::fmod(n * 0.7548776662466927, 1) * (high.x() - low.x());
      const double y = low.y() + std::fmod(n * 0.5698402909980532, 1) * (high.y() - low.y());
      in_body.clear();
      in_parts.clear();
      add_lines(body, x, y, in_body);
      for (const Columns& surface : columns) surface.add(x, y, in_body);
      add_lines(parts, x, y, in_parts);
      for (const Columns& surface : of_parts) surface.add(x, y, in_parts);
      here.body += join(in_body) * area / lines;
      here.parts += join(in_parts) * area / lines;
      here.both += common_length(in_body, in_parts) * area / lines;
    }
    sum.body += here.body / lattices;
    sum.parts += here.parts / lattices;
    sum.both += here.both / lattices;
    errors.push_back(here.body + here.parts - 2 * here.both);
  }
  const double mean = sum.body + sum.parts - 2 * sum.both;
  double squares = 0;
  for (double e : errors) squares += (e - mean) * (e - mean);
  sum.deviation = std::sqrt(squares / (lattices * (lattices - 1)));
  return sum;
}

}  // namespace touchstone::proxies
