// Volumes of unions, by intervals along parallel lines.
#include "harness/proxies/union_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "harness/base/random.h"

namespace touchstone::proxies {
namespace {

constexpr int lattices = 8, lines = 4096;
constexpr double rounding = 1e-12;  // relative to the volumes
constexpr int cells = 64;           // per direction, for finding triangles
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
  // Adds the intervals with a nonzero winding number. Returns the integral of that number.
  double add(double x, double y, Intervals& intervals) const {
    std::vector<std::pair<double, int>> crossings;
    for (std::uint32_t t : cells_[static_cast<std::size_t>(cell(x, 0) * cells + cell(y, 1))]) {
      cross(triangles_[t], x, y, crossings);
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    double start = 0, sum = 0;
    for (const auto& [z, turn] : crossings) {
      if (winding == 0) start = z;
      winding += turn;
      sum -= turn * z;
      if (winding == 0) intervals.emplace_back(start, z);
    }
    return sum;
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

// A union of solids, and the sum of their volumes.
class Union {
 public:
  Union(const std::vector<PlacedSolid>& solids, const std::vector<geometry::Triangle>& closed,
        const Vec3d& low, const Vec3d& high) {
    for (const PlacedSolid& solid : solids) {
      sum_ += solid.volume();
      if (solid.planes().size() > few_planes) {
        columns_.emplace_back(solid.surface(), low, high);
      } else {
        solids_.push_back(&solid);
      }
    }
    if (closed.empty()) return;
    const double volume = geometry::volume_of(closed);
    if (volume < 0) sign_ = -1;
    sum_ += std::abs(volume);
    closed_.emplace(closed, low, high);
  }
  double sum() const { return sum_; }
  // Returns the length of the union on a line, less the sum of its solids' lengths.
  double along(double x, double y, Intervals& intervals) const {
    intervals.clear();
    double sum = 0;
    for (const PlacedSolid* solid : solids_) {
      if (x < solid->low().x() || x > solid->high().x()) continue;
      const auto line = solid->along_z(x, y);
      if (!line) continue;
      intervals.push_back(*line);
      sum += line->second - line->first;
    }
    for (const Columns& surface : columns_) sum += surface.add(x, y, intervals);
    if (closed_) sum += sign_ * closed_->add(x, y, intervals);
    return join(intervals) - sum;
  }

 private:
  std::vector<const PlacedSolid*> solids_;
  std::vector<Columns> columns_;  // of polytopes
  std::optional<Columns> closed_;
  double sign_ = 1, sum_ = 0;
};

double length_of(const Intervals& intervals) {
  double length = 0;
  for (const auto& [low, high] : intervals) length += high - low;
  return length;
}

// Volumes on the lines of one lattice, or of all.
struct Sums {
  double body = 0, parts = 0;              // of the unions
  double body_lines = 0, parts_lines = 0;  // as the lines alone have them
  double both = 0;

  Sums& operator+=(const Sums& more) {
    body += more.body;
    parts += more.parts;
    body_lines += more.body_lines;
    parts_lines += more.parts_lines;
    both += more.both;
    return *this;
  }
  // Of what is common, if the errors of the lines' volumes are corrected for. `share` is 1 where
  // the parts hold the body, so that it is the common part, and 0 where the body holds the parts.
  double common(double share) const {
    return both - share * (body_lines - body) - (1 - share) * (parts_lines - parts);
  }
};

}  // namespace

Overlap overlap_of(const std::vector<PlacedSolid>& body,
                   const std::vector<geometry::Triangle>& closed,
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
  for (const geometry::Triangle& t : closed) {
    for (const Vec3d& p : {t.a, t.b, t.c}) widen(p);
  }
  const Union whole(body, closed, low, high), made(parts, {}, low, high);
  const double area = (high.x() - low.x()) * (high.y() - low.y());
  std::array<Sums, lattices> of;
  Sums all;
  base::Random random(1);
  Intervals in_body, in_parts;
  for (Sums& here : of) {
    const double right = random.unit(), up = random.unit();
    for (int i = 0; i < lines; ++i) {
      const double n = i + 0.5;
      const double x =
          low.x() + std::fmod(right + n * 0.7548776662466927, 1) * (high.x() - low.x());
      const double y = low.y() + std::fmod(up + n * 0.5698402909980532, 1) * (high.y() - low.y());
      here.body += whole.along(x, y, in_body) * area / lines;
      here.parts += made.along(x, y, in_parts) * area / lines;
      here.body_lines += length_of(in_body) * area / lines;
      here.parts_lines += length_of(in_parts) * area / lines;
      here.both += common_length(in_body, in_parts) * area / lines;
    }
    here.body += whole.sum();
    here.parts += made.sum();
    all += here;
  }
  const double added = all.parts_lines - all.both, lost = all.body_lines - all.both;
  const double share = added + lost > 0 ? std::clamp(added / (added + lost), 0.0, 1.0) : 1;
  const auto none_if_rounding = [&](double volume) {
    return volume > rounding * (all.body + all.parts) / lattices ? volume : 0;
  };
  Overlap sum;
  sum.body = none_if_rounding(all.body / lattices);
  sum.added = none_if_rounding((all.parts - all.common(share)) / lattices);
  sum.lost = none_if_rounding((all.body - all.common(share)) / lattices);
  if (sum.body == 0) return sum;
  // The error of a ratio follows from the differences that remain where each volume is replaced by
  // the ratio times the body's.
  const double ratio = (sum.added + sum.lost) / sum.body;
  double squares = 0;
  for (const Sums& here : of) {
    const double rest = here.parts + here.body - 2 * here.common(share) - ratio * here.body;
    squares += rest * rest;
  }
  sum.deviation = std::sqrt(squares / (lattices * (lattices - 1))) / sum.body;
  if (sum.deviation < rounding * (1 + ratio)) sum.deviation = 0;
  return sum;
}

}  // namespace touchstone::proxies
