// Moving pairs of which one turns, by construction.
#include "harness/families/turning_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace touchstone::families {
namespace {

constexpr double pi = std::numbers::pi;

// The rotation that lays z along x.
Mat3d z_along_x() {
  Mat3d rotation;
  rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  return rotation;
}

}  // namespace

MovingPairCase turning(ShapeKind a, ShapeKind b, double radians, Draws& random) {
  MovingPairCase c;
  c.a = random_shape(a, random);
  c.b = random_shape(b, random);
  c.pose_a.rotation = random.rotation();
  c.pose_b.rotation = random.rotation();
  c.pose_b.translation = random.uniform(2, 4) * random.direction();
  c.motion_a = {random.vector(1), radians * random.direction()};
  c.motion_b = {random.vector(2) - 0.5 * c.pose_b.translation, radians * random.direction()};
  c.toi = std::numeric_limits<double>::quiet_NaN();
  c.squarely = false;
  c.what = fmt::format("{}-{} turning by {}", to_string(a), to_string(b), radians);
  return c;
}

MovingPairCase turning_needle(bool hit, Draws& random) {
  const double thick = std::pow(10, random.uniform(-5, -2)), ball = random.uniform(0.001, 0.1);
  const double away = random.uniform(0.5, 0.95), angle = random.uniform(0.6, 2.4);
  const double reach = std::asin((thick + ball) / away);
  MovingPairCase c;
  c.what = "a needle turns in place";
  c.a = round_shape(ShapeKind::capsule, thick, 1);
  // The needle lies along x, and turns about z; the ball is at the angle from it.
  c.pose_a.rotation = z_along_x();
  c.b = round_shape(ShapeKind::sphere, ball, 0);
  c.pose_b.translation = away * Vec3d(std::cos(angle), std::sin(angle), 0);
  const double turn = (hit ? 1 : 0.9 * (angle - reach) / angle) * angle;
  c.motion_a.rotation_vector = {0, 0, turn};
  c.hit = turn > angle - reach;
  c.toi = (angle - reach) / turn;
  c.doubt = 1e-12;
  // The closing speed at contact is that of the touched point.
  c.speed = 0.5 * turn * away * std::cos(reach);
  c.gap = c.hit ? 0 : 1e-3;
  return c;
}

MovingPairCase sinking_rod(bool hit, Draws& random) {
  MovingPairCase c;
  c.what = "a spinning rod sinks";
  c.a = box_shape({2, 2, 0.1});
  c.b = round_shape(ShapeKind::capsule, 0.05, 1);
  c.pose_b.rotation = z_along_x();
  c.pose_b.translation = {0, 0, 0.1 + 0.05 + 0.5};
  c.motion_b.rotation_vector = {0, 0, random.uniform(-20, 20) * pi};
  const double sink = hit ? random.uniform(0.51, 3) : random.uniform(0, 0.499);
  c.motion_b.displacement = {0, 0, -sink};
  c.hit = sink > 0.5;
  c.toi = 0.5 / sink;
  c.speed = sink;
  c.gap = 0.5 - sink;
  c.doubt = 1e-12;
  return c;
}

MovingPairCase far_pivot(bool hit, Draws& random) {
  const double arm = std::pow(10, random.uniform(0, 4)), ball = 0.01;
  const double angle = random.uniform(0.2, 1.5);  // of the ball from the start
  MovingPairCase c;
  c.what = fmt::format("a point on an arm of {}", arm);
  c.a = hull_shape({{arm, 0, 0}});
  c.b = round_shape(ShapeKind::sphere, ball, 0);
  c.pose_b.translation = arm * Vec3d(std::cos(angle), std::sin(angle), 0);
  // The point meets the ball when the chord is the ball's radius.
  const double reach = 2 * std::asin(0.5 * ball / arm);
  const double turn = hit ? angle : angle - 2 * reach;
  c.motion_a.rotation_vector = {0, 0, turn};
  c.hit = hit;
  c.toi = (angle - reach) / turn;
  c.doubt = 1e-13 * arm / ball;
  c.speed = 0.5 * arm * turn;
  c.gap = c.hit ? 0 : 0.5 * ball;
  return c;
}

MovingPairCase passing_corner(double gap) {
  MovingPairCase c;
  c.what = fmt::format("a corner passes at {}", gap);
  c.a = box_shape({5, 1, 5});
  c.pose_a.translation = {0, -1 - std::sqrt(2.0) - gap, 0};
  c.b = box_shape({1, 1, 0.5});
  c.motion_b.rotation_vector = {0, 0, pi / 2};
  c.hit = gap < 0;
  c.gap = gap;
  // The corner at angle 5/4 pi turns to 7/4 pi, and is lowest halfway, sqrt(2) down.
  const double turn = std::acos(std::min(1.0, (std::sqrt(2.0) + gap) / std::sqrt(2.0)));
  c.toi = 0.5 - turn / (pi / 2);
  c.doubt = 1e-9;
  return c;
}

}  // namespace touchstone::families
