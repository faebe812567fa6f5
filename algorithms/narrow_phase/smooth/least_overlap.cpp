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

// Without a cap only flat bodies are proven, but a lower foot may have one.
constexpr int most_without_cap = 16;

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

// A normal along which the polytope may be too low, and a face that sees what is there.
struct Failure {
  int face = -1;  // -1: there is none
  Vec3d along = Vec3d::Zero();
};

// The part of the sphere of normals that the polytope has to prove: outside of the cap.
struct Rim {
  Vec3d normal = Vec3d::Zero();
  double cosine = 0;  // of the cap's angle; 0 without a cap
  double height = 0;  // that is to be proven

  // Positive if the vertex of the polar is inside of the plane of the rim.
  double inside(const Vec3d& m, double distance) const {
    return cosine > 0 ? height * m.dot(normal) - distance * cosine : -1;
  }
  Failure failure(const EpaHull<double>& surface) const;
  Failure failure_on_rim(const EpaHull<double>& surface) const;
};

// A face as a vertex of the polar.
struct PolarVertex {
  Vec3d normal;
  // A height that the polytope has along the normal, and, as far as the neighbours' heights say,
  // along those between: the least of the corners', whatever rounding did to the normal.
  double height;
  double inside;  // of the rim

  PolarVertex(const EpaHull<double>& surface, int face, const Rim& rim)
      : normal(surface.normal(face)) {
    const std::array<Vec3d, 3> corners = surface.points(surface.corners(face));
    height = std::min({normal.dot(corners[0]), normal.dot(corners[1]), normal.dot(corners[2])}) -
             rounding;
    inside = rim.inside(normal, height);
  }
};

// The lowest face outside of the rim, by the planes as they are; where none is too low, the proof
// itself.
Failure Rim::failure(const EpaHull<double>& surface) const {
  Failure found;
  double least = height + 2 * rounding;
  surface.all_faces([&](int f) {
    const double distance = surface.distance(f);
    if (!(distance < least)) return true;
    const Vec3d m = surface.normal(f);
    if (inside(m, distance) > 0) return true;
    least = distance;
    found = {f, m};
    return true;
  });
  return found.face < 0 ? failure_on_rim(surface) : found;
}

Failure Rim::failure_on_rim(const EpaHull<double>& surface) const {
  Failure found;
  double worst = 1 - 4 * rounding;
  const auto consider = [&](int face, const Vec3d& along, double reached) {
    const double square = along.squaredNorm();
    // Most are proven without a root.
    if (reached > 0 && reached * reached >= height * height * square) return;
    const double length = std::sqrt(square), part = reached / (height * length);
    if (!(part < worst)) return;
    worst = part;
    found = {face, (1 / length) * along};
  };
  surface.all_faces([&](int f) {
    const PolarVertex own(surface, f, *this);
    if (own.inside <= 0) {
      consider(f, own.normal, own.height);
      return true;
    }
    for (int k = 0; k < 3; ++k) {
      const PolarVertex other(surface, surface.neighbour(f, k), *this);
      if (other.inside > 0) continue;
      consider(f, own.inside * other.normal - other.inside * own.normal,
               own.inside * other.height - other.inside * own.height);
    }
    return true;
  });
  return found;
}

}  // namespace

std::optional<LeastOverlap> LeastOverlapSearch::find(SupportPair<double>& pair,
                                                     const Simplex<double>& simplex,
                                                     double tolerance) {
  if (simplex.size < 4 || !surface_.start(simplex.points)) return std::nullopt;
  const SmoothPair smooth(pair);
  const double margin = std::max(tolerance / 2, 8 * rounding);
  std::optional<LeastOverlap> found;
  Rim rim;
  // Descends from a normal. Returns true if its foot is lower than the last.
  const auto descend = [&](const Vec3d& from, bool at_kink) {
    const std::optional<SmoothFoot> foot = find_foot(smooth, from, at_kink);
    if (!foot || (found && !(foot->height < found->foot.height))) return false;
    // The slide lowers heights within the cap by as much at most.
    if (!(foot->held - foot->slide > foot->height - margin / 4) || !(foot->held > 4 * margin))
      return false;
    found = LeastOverlap{.foot = *foot, .lower = foot->held - margin};
    const double width = proven_width(smooth, *foot);
    const double cosine = width > 0 ? (1 + 1e-12) / std::sqrt(1 + width * width) : 0;
    rim = {foot->normal, cosine, found->lower};
    return true;
  };

  // The first normal is the lowest of the tetrahedron's faces and the kinks known.
  Vec3d first = Vec3d::UnitX();
  double least_height = std::numeric_limits<double>::infinity();
  surface_.all_faces([&](int f) {
    const Vec3d m = surface_.normal(f);
    const double height = smooth.height(m);
    if (height < least_height) {
      least_height = height;
      first = m;
    }
    return true;
  });
  const std::optional<Vec3d> kink = best_kink(smooth, least_height);
  descend(kink ? *kink : first, kink.has_value());

  int points = 4, iterations = 0;
  // Adds the support point along m, which the face sees. Returns false if that proves nothing more.
  const auto extend = [&](const Vec3d& m, int face) {
    const bool has_cap = !found || rim.cosine > 0;
    if (points >= (has_cap ? most_points_ : std::min(most_points_, most_without_cap))) return false;
    const DifferencePoint<double> point = pair.support(m);
    ++iterations;
    const double height = m.dot(point.difference);
    if (!found || height < found->foot.height) descend(m, false);
    if (found && height < found->lower) return false;
    if (!surface_.add(point, face, std::numeric_limits<double>::infinity())) return false;
    ++points;
    return true;
  };

  for (;;) {
    const Failure failure = found ? rim.failure(surface_) : Failure{};
    if (found && failure.face < 0) break;
    if (!found) {
      const auto nearest = surface_.nearest_face();
      if (nearest.face < 0 || !extend(surface_.normal(nearest.face), nearest.face)) {
        return std::nullopt;
      }
    } else if (!extend(failure.along, failure.face)) {
      return std::nullopt;
    }
  }
  found->iterations = iterations;
  return found;
}

}  // namespace touchstone
