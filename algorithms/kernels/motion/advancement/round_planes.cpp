// Prediction of the normal of first contact of spheres and capsules.
#include "algorithms/kernels/motion/advancement/round_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// A vector that turns, to second order of the time.
struct TurningAxis {
  TurningAxis(const Vec3d& axis, const Vec3d& turn)
      : start(axis), velocity(turn.cross(axis)), acceleration(turn.cross(velocity)) {}
  Vec3d at(double h) const { return start + h * (velocity + 0.5 * h * acceleration); }
  Vec3d velocity_at(double h) const { return velocity + h * acceleration; }

  Vec3d start, velocity, acceleration;
};

}  // namespace

Vec3d lasting_normal(SupportPair<double>& pair, const PairMotion& motion, const ClosestOfRound& now,
                     double left, double least_gap) {
  const TurningAxis p(half_axis(pair.a()), motion.turn_a), q(half_axis(pair.b()), motion.turn_b);
  const Vec3d velocity = motion.velocity / pair.unit();
  const Vec3d& offset = pair.centre_b();
  const double radius = pair.radius();
  const auto part = [](const Vec3d& on, const Vec3d& axis) {
    return axis.isZero(0) ? 0 : on.dot(axis) / axis.squaredNorm();
  };

  Vec3d best = Vec3d::Zero();
  ClosestOfRound closest = now;
  double time = 0;
  double approaching = 0, approach = 0;  // the last time with a rate below zero, and that rate
  double parting = std::numeric_limits<double>::infinity(), part_rate = 0;
  constexpr int most_looks = 5;
  for (int k = 0; k < most_looks; ++k) {
    const double distance = closest.between.norm();
    if (!(distance > 0)) break;
    const Vec3d normal = closest.between / distance;
    const bool open = normal.dot(offset) - std::abs(normal.dot(p.start)) -
                          std::abs(normal.dot(q.start)) - radius >
                      least_gap;
    if (open || k == 0) best = normal;
    const double s = part(closest.on_a, p.at(time)), t = part(closest.on_b, q.at(time));
    const double rate = normal.dot(velocity + t * q.velocity_at(time) - s * p.velocity_at(time));
    const double gap = distance - radius;
    double next = left;
    if (rate < 0) {
      approaching = time;
      approach = rate;
      next = std::min(time - gap / rate, left);
    } else {
      if (open) break;
      parting = time;
      part_rate = rate;
    }
    if (!(next < parting)) {
      next = approaching + (parting - approaching) * approach / (approach - part_rate);
    }
    // A normal that is off by the change of the gap loses the square of that.
    if (!(std::abs(gap * gap) > least_gap) || next == time) break;
    time = next;
    closest = closest_of_segments(p.at(time), q.at(time), offset + time * velocity);
  }
  return best;
}

}  // namespace touchstone
