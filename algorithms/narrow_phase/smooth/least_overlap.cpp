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
constexpr std::array<double, 8> widths = {3, 1.8, 1.1, 0.7, 0.45, 0.25, 0.12, 0.04};

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

}  // namespace

std::optional<LeastOverlap> LeastOverlapSearch::find(SupportPair<double>& pair,
                                                     const Simplex<double>& simplex,
                                                     double tolerance) {
  if (simplex.size < 4 || !surface_.start(simplex.points)) return std::nullopt;
  const SmoothPair smooth(pair);
  const double margin = std::max(tolerance / 2, 8 * rounding);
  std::optional<LeastOverlap> found;
  Rim rim;
  bool is_rim_new = false;
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
    is_rim_new = true;
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
    if (found && !is_rim_new) proof_.extend(surface_);
    return true;
  };

  for (;;) {
    if (is_rim_new) proof_.start(surface_, rim);
    is_rim_new = false;
    const RimProof::Failure failure = found ? proof_.failure(surface_) : RimProof::Failure{};
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
