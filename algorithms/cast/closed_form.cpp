// Closed form: the time of impact of balls, of a ball and a capsule, and of anything and a half-space.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, sections 5.5.5 (moving spheres) and 5.3.7
//          (a ray and a capsule).
// Steps:   1. The ball's centre moves along a segment past the capsule's axis; contact is where it comes
//             as near as R, the sum of the radii. A ball is an axis of no length.
//          2. The closest points of path and axis give a plane. If the bodies are apart along it at both
//             ends, it is a miss.
//          3. Otherwise the path enters the cylinder of radius R about the axis, or the ball at an end of
//             it, at the root of a quadratic.
//          4. The plane of contact there proves until when the bodies are apart, since the gap along it is
//             linear in time. If that is not yet within the tolerance, as for bodies that graze, the plane
//             at that time is next.
//          5. A time a little later, at which the centre is nearer than R, is the upper end.
// Departs: `lower` is certified by the plane, with the rounding of its gap; the root is only a guess of it.
//          Half-spaces: motion/halfspace_cast.
// Fails:   not_converged at the cap of 128 planes. Other kinds of pairs are not supported.
// Cost:    some tens of products and two roots. Tolerance: 1e-9 of the larger body's size.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/kernels/motion/halfspace_cast.h"
#include "algorithms/kernels/motion/keep_to_tolerance.h"

namespace touchstone {
namespace {

// The centre of ball a as seen from the centre of body b, whose axis is from -axis to +axis. Metres.
struct BallPath {
  Vec3d start, velocity, axis;
  double radius;  // R
  // The error of a gap along a unit vector, with u half of epsilon: start, velocity and axis are off by
  // u each, their products with the vector by 3 u, its length by 3 u, the sums by 4 u: in all 12 u of
  // the sum of the lengths. The bound is more than twice that.
  double rounding;

  Vec3d at(double time) const { return start + time * velocity; }
  // From the axis' nearest point to the centre.
  Vec3d from_axis(const Vec3d& centre) const {
    const double square = axis.squaredNorm();
    const double place = square > 0 ? std::clamp(centre.dot(axis) / square, -1.0, 1.0) : 0;
    return centre - place * axis;
  }
  // The gap along a unit vector from b to a.
  double gap(const Vec3d& normal, const Vec3d& centre) const {
    return normal.dot(centre) - std::abs(normal.dot(axis)) - radius;
  }
};

// The first time at which |offset + t velocity| = radius, or infinity; 0 if it is less at the start.
double entry(const Vec3d& offset, const Vec3d& velocity, double radius) {
  const double away = offset.norm();
  const double c = (away - radius) * (away + radius);
  if (!(c > 0)) return 0;
  const double a = velocity.squaredNorm(), b = -offset.dot(velocity);
  const double discriminant = b * b - a * c;
  if (!(b > 0) || !(discriminant >= 0)) return std::numeric_limits<double>::infinity();
  return c / (b + std::sqrt(discriminant));
}

// A guess of the first time in [0, 1] at which the centre is at the distance R from the axis.
double guess(const BallPath& path) {
  const double square = path.axis.squaredNorm();
  double first = std::min(entry(path.start - path.axis, path.velocity, path.radius),
                          entry(path.start + path.axis, path.velocity, path.radius));
  if (square > 0) {
    const auto across = [&](const Vec3d& v) {
      return Vec3d(v - v.dot(path.axis) / square * path.axis);
    };
    const double time = entry(across(path.start), across(path.velocity), path.radius);
    if (time < first && std::abs(path.at(time).dot(path.axis)) <= square) first = time;
  }
  return std::clamp(first, 0.0, 1.0);
}

// The time at which the path is nearest to the axis: Ericson, section 5.1.9.
double nearest_time(const BallPath& path) {
  const Vec3d &v = path.velocity, &m = path.axis;
  const double vv = v.squaredNorm(), mm = m.squaredNorm(), vm = v.dot(m);
  const double sv = path.start.dot(v), sm = path.start.dot(m);
  if (!(vv > 0)) return 0;
  if (!(mm > 0)) return std::clamp(-sv / vv, 0.0, 1.0);
  const double determinant = vv * mm - vm * vm;
  double time = determinant > 0 ? std::clamp((vm * sm - mm * sv) / determinant, 0.0, 1.0) : 0;
  const double place = std::clamp((sm + time * vm) / mm, -1.0, 1.0);
  return std::clamp((place * vm - sv) / vv, 0.0, 1.0);
}

// A unit vector at right angles to the axis and to the velocity.
Vec3d across_both(const BallPath& path) {
  const Vec3d both = path.axis.stableNormalized().cross(path.velocity.stableNormalized());
  if (!both.isZero(0)) return both.stableNormalized();
  const Vec3d& line = path.axis.isZero(0) ? path.velocity : path.axis;
  return line.isZero(0) ? Vec3d(Vec3d::UnitX()) : line.unitOrthogonal();
}

class ClosedFormCast final : public Cast {
 public:
  explicit ClosedFormCast(const CastSettings& settings)
      : settings_(settings), most_planes_(std::max(1, settings.max_iterations.value_or(128))) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = shapes;
    support_shapes_ = make_support_shapes<double>(shapes);
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      const std::uint32_t shape_a = pairs.shape_of[a], shape_b = pairs.shape_of[b];
      outcomes[i] = {};
      if (batch.kind_b == ShapeKind::halfspace) {
        cast_halfspace(support_shapes_[shape_a], pairs.poses[a], batch.motions[a],
                       support_shapes_[shape_b], pairs.poses[b], batch.motions[b],
                       {settings_.tolerance, settings_.start}, outcomes[i]);
      } else {
        cast_ball(shapes_[shape_a], pairs.poses[a], batch.motions[a], shapes_[shape_b],
                  pairs.poses[b], batch.motions[b], outcomes[i]);
      }
    }
  }

 private:
  void cast_ball(const Shape& a, const Pose& pose_a, const Motion& motion_a, const Shape& b,
                 const Pose& pose_b, const Motion& motion_b, CastOutcome& outcome) const;
  void hit(const BallPath& path, double tolerance, CastOutcome& outcome) const;

  CastSettings settings_;
  int most_planes_;
  std::span<const Shape> shapes_;
  std::vector<SupportShape<double>> support_shapes_;
};

void ClosedFormCast::cast_ball(const Shape& a, const Pose& pose_a, const Motion& motion_a,
                               const Shape& b, const Pose& pose_b, const Motion& motion_b,
                               CastOutcome& outcome) const {
  const double length = b.kind == ShapeKind::capsule ? b.half_length : 0;
  BallPath path = {.start = pose_a.translation - pose_b.translation,
                   .velocity = motion_a.displacement - motion_b.displacement,
                   .axis = length * pose_b.rotation.col(2),
                   .radius = a.radius + b.radius,
                   .rounding = 0};
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  path.rounding =
      16 * epsilon * (path.start.norm() + path.velocity.norm() + path.axis.norm() + path.radius);
  outcome.iterations = 0;
  outcome.status = Status::not_converged;
  if (!(path.rounding < 0x1p450 && (path.rounding > 0x1p-450 || path.rounding == 0))) {
    outcome.status = Status::degenerate;  // squares overflow, or underflow
    return;
  }
  const Vec3d nearest = path.from_axis(path.at(nearest_time(path)));
  const double distance = nearest.norm();
  const Vec3d across = distance > 0 ? Vec3d(nearest / distance) : Vec3d(Vec3d::Zero());
  const auto least_gap = [&](const Vec3d& normal) {
    return std::min(path.gap(normal, path.start), path.gap(normal, path.at(1)));
  };
  if (distance > 0 && least_gap(across) > path.rounding) {
    outcome.answer = CastAnswer::miss;
    outcome.status = Status::ok;
    return;
  }
  const double size = std::max(a.radius, length + b.radius);
  const double tolerance = std::max(settings_.tolerance.value_or(1e-9 * size), 16 * path.rounding);
  hit(path, tolerance, outcome);
  if (outcome.answer != CastAnswer::hit) return;
  const Vec3d from = path.from_axis(path.at(outcome.toi));
  const double away = from.norm();
  const Vec3d normal = away > 0 ? Vec3d(from / away) : Vec3d(Vec3d::Zero());
  if (settings_.start == StartContact::approach && outcome.toi == 0) {
    // With path.rounding, a computed gap proves that the bodies are no deeper than the tolerance.
    // Balls and a capsule that are no thicker keep to any plane along the axis and the path.
    const Vec3d along_both = path.radius <= tolerance ? across_both(path) : Vec3d(Vec3d::Zero());
    for (const Vec3d& plane : {normal, across, along_both}) {
      if (plane.isZero(0) || least_gap(plane) < path.rounding - tolerance) continue;
      const int planes = outcome.iterations;
      outcome = {};
      outcome.answer = CastAnswer::miss;
      outcome.status = Status::ok;
      outcome.iterations = planes;
      return;
    }
  }
  if (away > 0) outcome.normal = -normal;
  // Bodies that overlap at the start share a point that is as deep in either, in proportion to their radii.
  const double deep = away < path.radius ? away / path.radius : 1;
  outcome.point =
      pose_a.translation + outcome.toi * motion_a.displacement - deep * a.radius * normal;
  keep_to_tolerance(settings_.tolerance, 16 * path.rounding, outcome);
}

// Finds the hit, or a miss that the first plane could not prove.
void ClosedFormCast::hit(const BallPath& path, double tolerance, CastOutcome& outcome) const {
  double time = 0, look = guess(path);
  for (int k = 0; k < most_planes_; ++k, look = time) {
    ++outcome.iterations;
    // The plane at the guess, and then at the time until which the bodies are apart.
    const Vec3d from = path.from_axis(path.at(look));
    const double away = from.norm();
    if (k > 0 && away <= path.radius + tolerance) {
      outcome.answer = CastAnswer::hit;
      break;
    }
    if (!(away > 0)) continue;
    const Vec3d normal = from / away;
    const double gap = path.gap(normal, path.start), speed = -normal.dot(path.velocity);
    // The gap is linear in time: if it is open at `time`, which it is reached from, and at a later time,
    // then between them too.
    if (!(gap - time * speed > path.rounding)) continue;
    if (gap - speed > path.rounding) {
      outcome.answer = CastAnswer::miss;
      outcome.status = Status::ok;
      return;
    }
    const double reached = (gap - path.rounding) / speed * (1 - 4e-16);
    if (k > 0 && !(reached > time)) break;
    time = std::clamp(reached, time, 1.0);
  }
  outcome.lower = time;
  if (outcome.answer != CastAnswer::hit) return;
  outcome.status = Status::ok;
  outcome.toi = time;
  const auto surely = [&](double t) {
    return path.from_axis(path.at(t)).norm() + path.rounding < path.radius;
  };
  if (!(time > 0) && surely(0)) {
    outcome.upper = 0;
    return;
  }
  const Vec3d from = path.from_axis(path.at(time));
  const double away = from.norm();
  const double speed = away > 0 ? -from.dot(path.velocity) / away : 0;
  const double depth = std::max(away - path.radius, 0.0) + 4 * path.rounding;
  double step = speed > 0 ? depth / speed : 1;
  for (int k = 0; k < 24; ++k, step *= 4) {
    const double later = std::min(time + step, 1.0);
    if (surely(later)) {
      outcome.upper = later;
      return;
    }
    if (!(later < 1)) return;
  }
}

bool supports_closed_form(ShapeKind kind_a, ShapeKind kind_b, bool) {
  return kind_b == ShapeKind::halfspace ||
         (kind_a == ShapeKind::sphere && kind_b <= ShapeKind::capsule);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_closed_form() {
  return {
      {.info = {.name = "closed-form",
                .citation = "Ericson, \"Real-Time Collision Detection\", 2005, sections 5.5.5 and "
                            "5.3.7"},
       .scalars = {Precision::float64},
       .approach = true,
       .in_time = true,
       .supports = supports_closed_form,
       .make = [](const CastSettings& settings) {
         return std::make_unique<ClosedFormCast>(settings);
       }}};
}

}  // namespace touchstone::entries
