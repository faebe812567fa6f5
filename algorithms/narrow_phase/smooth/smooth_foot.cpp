// Newton's method on the smooth parts of the sphere of normals, on the circles where two ends of a
// core tie, and the normals where two circles meet or an axis passes.
#include "algorithms/narrow_phase/smooth/smooth_foot.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

constexpr double settled = 2e-15;     // a slide of rounding only, for lengths of about 1
constexpr double most_slide = 1e-11;  // of a foot
constexpr double almost = 1e-9;       // Newton's next step squares this
constexpr double longest_step = 0.5;  // radians
constexpr int most_steps = 12;
// Kinks further away than this are not tried.
constexpr double near_kink = 0.7;

Vec3d unit(const Vec3d& v) { return (1 / std::sqrt(v.squaredNorm())) * v; }

// Both cores at a normal, with the smooth piece of each that is furthest.
struct At {
  At(const SmoothPair& pair, const Vec3d& n, int& calls)
      : normal(n), a(pair.a.furthest(n)), b(pair.b.furthest(n)) {
    ++calls;
    const Vec3d point = a.point + b.point + pair.offset;
    height = a.height + b.height + n.dot(pair.offset);
    slide = point - n.dot(point) * n;
    slide_squared = slide.squaredNorm();
  }
  Vec3d normal;
  SmoothPoint a, b;
  double height, slide_squared;
  Vec3d slide;
};

// Where Newton's steps on the sphere ended: at a stationary normal, before a tie of a or of b, or for
// another reason.
enum class End : std::uint8_t { stationary, tie_of_a, tie_of_b, other };

bool is_across(const SmoothCore& core, const Vec3d& n, const Vec3d& m) {
  return core.has_tie() && core.angle_to_tie(n) * core.angle_to_tie(m) < 0;
}

// Newton steps on the sphere, for pieces without kinks.
End descend(const SmoothPair& pair, Vec3d& normal, int& calls) {
  At at(pair, normal, calls);
  for (int step = 0; step < most_steps; ++step) {
    if (at.slide_squared <= settled * settled) break;
    // The step from here is exact to rounding, and its foot is tested.
    const bool is_last = at.slide_squared <= almost * almost;
    Curvature curvature;
    pair.a.add_curvature(at.a, 0, 1, curvature);
    pair.b.add_curvature(at.b, 0, 1, curvature);
    const double trace = curvature.trace();
    const double minors = std::max(curvature.minors(), 0.0);
    double shift = -at.height;
    if (!(minors + shift * (trace + shift) > 0 && trace + 2 * shift > 0)) {
      // Not convex here: the curvature alone, and what it lacks, still gives a descent.
      shift = 0.1 * (trace + std::abs(at.height));
    }
    const double determinant = minors + shift * (trace + shift);
    if (!(determinant > 0)) break;
    Vec3d turn = (-1 / determinant) * ((trace + shift) * at.slide - curvature * at.slide);
    const double length = std::sqrt(turn.squaredNorm());
    if (!(length < longest_step)) turn *= longest_step / length;
    if (is_last) {
      normal = unit(at.normal + turn);
      return End::stationary;
    }
    bool better = false;
    for (int half = 0; half < 4 && !better; ++half) {
      const At next(pair, unit(at.normal + turn), calls);
      better = next.height < at.height - 1e-16 ||
               (next.height < at.height + 1e-15 && next.slide_squared < at.slide_squared);
      if (better) {
        at = next;
        break;
      }
      normal = at.normal;
      if (is_across(pair.a, at.normal, next.normal)) return End::tie_of_a;
      if (is_across(pair.b, at.normal, next.normal)) return End::tie_of_b;
      turn *= 0.25;
    }
    if (!better) break;
  }
  normal = at.normal;
  return at.slide_squared <= most_slide * most_slide ? End::stationary : End::other;
}

// Newton steps along the circle of normals where the ends of `tied` tie, whose own height is the
// same all along. Returns false if there is no minimum for the other core.
bool descend_on_circle(const SmoothCore& tied, const SmoothCore& other, const Vec3d& offset,
                       Vec3d& normal, int& calls) {
  const Vec3d& axis = tied.axis();
  const double tilt = tied.tilt(), width = std::sqrt(1 - tilt * tilt);
  Vec3d across = normal - normal.dot(axis) * axis;
  const double length = std::sqrt(across.squaredNorm());
  if (!(length > 1e-6) || !(width > 1e-12)) return false;
  across *= width / length;
  for (int step = 0; step < most_steps; ++step) {
    normal = tilt * axis + across;
    const SmoothPoint at = other.furthest(normal);
    ++calls;
    const Vec3d point = at.point + offset;
    const Vec3d along = axis.cross(across);  // the normal's derivative by the angle
    const double slope = point.dot(along);
    if (std::abs(slope) <= settled) break;
    Curvature curvature;
    other.add_curvature(at, 0, 1, curvature);
    const double bend = along.dot(curvature * along) - point.dot(across);
    double angle = bend > 0 ? -slope / bend : -std::copysign(0.3, slope);
    angle = std::clamp(angle, -longest_step, longest_step);
    across += angle * along;
    across -= across.dot(axis) * axis;
    across *= width / std::sqrt(across.squaredNorm());
    if (std::abs(angle) < almost) break;
  }
  normal = tilt * axis + across;
  return true;
}

// The normals where both circles meet: `middle` plus and minus `half`.
struct Meeting {
  Vec3d middle, half;

  // That nearest to n.
  Vec3d near(const Vec3d& n) const {
    return unit(half.dot(n) < 0 ? Vec3d(middle - half) : Vec3d(middle + half));
  }
};

std::optional<Meeting> meet(const SmoothCore& a, const SmoothCore& b) {
  const double d = a.axis().dot(b.axis());
  const Vec3d cross = a.axis().cross(b.axis());
  const double square = cross.squaredNorm();
  if (!(square > 1e-12)) return std::nullopt;
  const double of_a = (a.tilt() - d * b.tilt()) / square, of_b = (b.tilt() - d * a.tilt()) / square;
  const double left = (1 - of_a * a.tilt() - of_b * b.tilt()) / square;
  if (!(left > 0)) return std::nullopt;
  return Meeting{of_a * a.axis() + of_b * b.axis(), std::sqrt(left) * cross};
}

}  // namespace

std::optional<SmoothFoot> find_foot(const SmoothPair& pair, const Vec3d& start, bool at_kink) {
  SmoothFoot foot;
  int calls = 0;
  const auto is_foot = [&](const Vec3d& normal) {
    foot.support_calls = calls;
    return make_foot(pair, normal, foot) <= most_slide;
  };
  const double before = pair.height(start) + 1e-15;
  const auto is_lower_foot = [&](const Vec3d& normal) {
    return is_foot(normal) && foot.height <= before;
  };
  const auto descends_on_tie = [&](bool of_a, Vec3d normal) {
    const SmoothCore &tied = of_a ? pair.a : pair.b, &other = of_a ? pair.b : pair.a;
    return descend_on_circle(tied, other, pair.offset, normal, calls) && is_lower_foot(normal);
  };
  Vec3d normal = start;
  if (at_kink && is_foot(start)) return foot;
  const End end = descend(pair, normal, calls);
  if (end == End::stationary && is_lower_foot(normal)) return foot;
  const bool first = end == End::tie_of_a, tied = first || end == End::tie_of_b;
  if (tied && descends_on_tie(first, normal)) return foot;
  const auto is_near_tie = [&](const SmoothCore& core) {
    return core.has_tie() && std::abs(core.angle_to_tie(normal)) < near_kink;
  };
  const bool tie_a = is_near_tie(pair.a), tie_b = is_near_tie(pair.b);
  if (tie_a && tie_b) {
    const std::optional<Meeting> meeting = meet(pair.a, pair.b);
    if (meeting && is_lower_foot(meeting->near(normal))) return foot;
  }
  for (const bool of_a : {!first, first}) {
    if (of_a == first && tied) continue;
    if ((of_a ? tie_a : tie_b) && descends_on_tie(of_a, normal)) return foot;
  }
  for (const SmoothCore* core : {&pair.a, &pair.b}) {
    if (!core->has_disc()) continue;
    const double along = core->axis().dot(normal);
    if (core->is_cone() && along > 0) continue;
    if (std::abs(along) > 1 - near_kink * near_kink &&
        is_lower_foot(std::copysign(1.0, along) * core->axis())) {
      return foot;
    }
  }
  return std::nullopt;
}

std::optional<Vec3d> best_kink(const SmoothPair& pair, double below) {
  std::optional<Vec3d> best;
  const auto consider = [&](const Vec3d& n) {
    const double height = pair.height(n);
    if (!(height < below)) return;
    below = height;
    best = n;
  };
  for (const SmoothCore* core : {&pair.a, &pair.b}) {
    if (!core->has_disc()) continue;
    consider(-core->axis());
    if (!core->is_cone()) consider(core->axis());
  }
  if (pair.a.has_tie() && pair.b.has_tie()) {
    if (const std::optional<Meeting> meeting = meet(pair.a, pair.b)) {
      consider(unit(meeting->middle + meeting->half));
      consider(unit(meeting->middle - meeting->half));
    }
  }
  return best;
}

}  // namespace touchstone
