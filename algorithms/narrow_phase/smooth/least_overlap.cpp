// The cap around a foot, and the polytope outside of it.
#include "algorithms/narrow_phase/smooth/least_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

constexpr double rounding = SupportPair<double>::rounding;
// Widths of caps (tangents of their angles) that are tried.
constexpr std::array<double, 6> widths = {2, 1, 0.5, 0.25, 0.1, 0.03};

// Adds the lower bound of a core's part of K.
void add_bound(const SmoothCore& core, const SmoothFace& face, double width, Curvature& sum) {
  using Kind = SmoothFace::Kind;
  // Lengths are off by the rotation's own rounding.
  const double more = 1.001 * core.radius() * width;
  double weight = 1;
  if (face.kind == Kind::tie) {
    const double length = std::sqrt(face.first.squaredNorm());
    // A cone's curvature belongs to its rim alone. Half of the lesser end's share may go to the
    // other end, and the excess of that is twice the half segment's.
    weight = core.is_cone() ? 0.25 * (1 - face.first_share) : 1;
    const double excess = core.is_cone() ? face.slack : 2 * face.slack;
    sum.add(excess / (1.001 * length * width), face.first);
  } else if (face.kind == Kind::disc) {
    const double excess = 2 * face.slack / more;
    sum.add(excess, face.first);
    sum.add(excess, face.second);
    return;
  }
  core.add_curvature(face.furthest, more, weight, sum);
}

// Returns the widest cap around the foot in which no height is below the foot's, or 0.
double proven_width(const SmoothPair& pair, const SmoothFoot& foot) {
  for (const double width : widths) {
    Curvature bound;
    add_bound(pair.a, foot.a, width, bound);
    add_bound(pair.b, foot.b, width, bound);
    const double shift = -foot.held * (1 + 1e-9), trace = bound.trace();
    // Kinks may have a part along the normal, of rounding: the least eigenvalue across is bounded by
    // the determinant of the part across.
    const double determinant = bound.minors() + shift * (trace + shift);
    if (determinant > 1e-12 * trace * trace && trace + 2 * shift > 0) return width;
  }
  return 0;
}

// The part of the sphere of normals that the polytope has to prove.
struct Rim {
  Rim(const SmoothFoot& foot, double width, double least)
      : normal(foot.normal),
        cosine(width > 0 ? (1 + 1e-12) / std::sqrt(1 + width * width) : 0),
        height(least) {}

  Vec3d normal;
  double cosine;  // of the cap's angle; 0 without a cap
  double height;  // that is to be proven

  // Positive if the vertex of the polar is inside of the plane of the rim.
  double inside(const Vec3d& m, double distance) const {
    return cosine > 0 ? height * m.dot(normal) - distance * cosine : -1;
  }
};

// A height that the polytope has along the face's normal, and along those of its corners' cones as
// far as the neighbours' heights say: the least of its corners', whatever rounding did to the normal.
double height_of(const EpaHull<double>& surface, int face, const Vec3d& m) {
  const std::array<Vec3d, 3> corners = surface.points(surface.corners(face));
  return std::min({m.dot(corners[0]), m.dot(corners[1]), m.dot(corners[2])}) - rounding;
}

}  // namespace

std::optional<LeastOverlap> LeastOverlapSearch::find(SupportPair<double>& pair,
                                                     const Simplex<double>& simplex,
                                                     double tolerance) {
  if (simplex.size < 4 || !surface_.start(simplex.points)) return std::nullopt;
  const SmoothPair smooth(pair);
  const double margin = std::max(tolerance / 2, 8 * rounding);
  std::optional<LeastOverlap> found;
  Rim rim(SmoothFoot{}, 0, 0);
  // Descends from a normal. Returns true if its foot is lower than the last.
  const auto descend = [&](const Vec3d& from) {
    const std::optional<SmoothFoot> foot = find_foot(smooth, from);
    if (!foot || (found && !(foot->height < found->foot.height))) return false;
    if (!(foot->held > foot->height - margin / 4) || !(foot->held > 4 * margin)) return false;
    found = LeastOverlap{.foot = *foot, .lower = foot->held - margin};
    const double width = proven_width(smooth, *foot);
    rim = Rim(*foot, width, found->lower);
    return true;
  };

  int points = 4, iterations = 0;
  // Adds the support point along m, which the face sees. Returns false if that proves nothing more.
  const auto extend = [&](const Vec3d& m, int face) {
    if (points == most_points_) return false;
    const DifferencePoint<double> point = pair.support(m);
    ++iterations;
    const double height = m.dot(point.difference);
    if (!found || height < found->foot.height) descend(m);
    if (found && height < found->lower) return false;
    if (!surface_.add(point, face, std::numeric_limits<double>::infinity())) return false;
    ++points;
    return true;
  };

  for (;;) {
    // Where the proof fails most, and a face that sees what is there.
    int worst = -1;
    Vec3d along = Vec3d::Zero();
    double least = 1 - 4 * rounding;
    surface_.all_faces([&](int f) {
      const Vec3d m = surface_.normal(f);
      const double distance = height_of(surface_, f, m);
      if (!found) {
        if (worst < 0 || distance < least) {
          least = distance;
          worst = f;
          along = m;
        }
        return true;
      }
      const double inside = rim.inside(m, distance);
      if (inside <= 0) {
        const double reached = distance / rim.height;
        if (reached < least) {
          least = reached;
          worst = f;
          along = m;
        }
        return true;
      }
      for (int k = 0; k < 3; ++k) {
        const int g = surface_.neighbour(f, k);
        const Vec3d other = surface_.normal(g);
        const double distance_g = height_of(surface_, g, other);
        const double outside = -rim.inside(other, distance_g);
        if (outside < 0) continue;
        const Vec3d crossing = outside * m + inside * other;
        const double plane = outside * distance + inside * distance_g;
        const double length = std::sqrt(crossing.squaredNorm());
        const double reached = plane / (rim.height * length);
        if (reached < least) {
          least = reached;
          worst = f;
          along = (1 / length) * crossing;
        }
      }
      return true;
    });
    if (worst < 0) break;
    if (!extend(along, worst)) return std::nullopt;
  }
  found->iterations = iterations;
  return found;
}

}  // namespace touchstone
