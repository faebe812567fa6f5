// Moving pairs by construction.
#include "harness/families/moving_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "algorithms/core/bounds.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::families {
namespace {

// Places b so that its support along -normal is at `gap` from a's along +normal, and moves both.
void place(MovingPairCase& c, const Vec3d& normal, double gap) {
  const Vec3d on_a = support_point(c.a, c.pose_a, normal);
  c.pose_b.translation += on_a + gap * normal - support_point(c.b, c.pose_b, -normal);
}

// A point inside the body, in the world.
Vec3d middle_of(const Shape& shape, const Pose& pose) {
  if (shape.kind != ShapeKind::hull) return pose.translation;
  Vec3d mean = Vec3d::Zero();
  for (const Vec3d& v : shape.hull->vertices) mean += v;
  return pose(mean / static_cast<double>(shape.hull->vertices.size()));
}

MovingPairCase random_pair(ShapeKind a, ShapeKind b, Draws& random) {
  MovingPairCase c;
  c.a = random_shape(a, random);
  c.b = random_shape(b, random);
  c.pose_a = {random.rotation(), random.vector(1)};
  c.pose_b = {random.rotation(), Vec3d::Zero()};
  return c;
}

}  // namespace

Shape round_shape(ShapeKind kind, double radius, double half_length) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}

Shape box_shape(const Vec3d& half_extents) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = half_extents;
  return shape;
}

Shape hull_shape(std::vector<Vec3d> vertices) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_hull(std::move(vertices));
  return shape;
}

Shape random_shape(ShapeKind kind, Draws& random) {
  const auto size = [&] { return random.uniform(0.3, 1); };
  switch (kind) {
    case ShapeKind::sphere: return round_shape(kind, size(), 0);
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: {
      const double radius = size();
      return round_shape(kind, radius, size());
    }
    case ShapeKind::box: return box_shape({size(), size(), size()});
    case ShapeKind::ellipsoid: {
      Shape shape;
      shape.kind = kind;
      shape.radii = {size(), size(), size()};
      return shape;
    }
    default: break;
  }
  std::vector<Vec3d> vertices;
  const int count = 4 + random.below(28);
  for (int i = 0; i < count; ++i) {
    const Vec3d direction = random.direction();
    vertices.push_back(random.uniform(0.5, 1) * direction);
  }
  return hull_shape(std::move(vertices));
}

Pose pose_at(const Pose& pose, const Motion& motion, double time) {
  const double angle = motion.rotation_vector.norm();
  Pose at = pose;
  if (angle > 0) {
    at.rotation = Eigen::AngleAxisd(time * angle, motion.rotation_vector / angle) * pose.rotation;
  }
  at.translation += time * motion.displacement;
  return at;
}

Vec3d contact_normal(ContactFeature feature, const Pose& a, const Pose& b, Draws& random) {
  const int axis = random.below(3);
  if (feature == ContactFeature::face) return a.rotation.col(axis);
  if (feature == ContactFeature::edges) {
    return a.rotation.col(axis).cross(b.rotation.col(random.below(3))).normalized();
  }
  return random.direction();
}

MovingPairCase meeting(ShapeKind a, ShapeKind b, ContactFeature feature, double toi, double path,
                       Draws& random) {
  MovingPairCase c = random_pair(a, b, random);
  const Vec3d normal = contact_normal(feature, c.pose_a, c.pose_b, random);
  place(c, normal, 0);
  c.inward = middle_of(c.a, c.pose_a) - middle_of(c.b, c.pose_b);
  c.squarely = random.below(2) == 0;
  Vec3d velocity = path * (c.squarely ? Vec3d(c.inward.normalized()) : random.direction());
  if (velocity.dot(normal) > 0) velocity = -velocity;
  if (!c.squarely) velocity -= 0.1 * path * normal;
  c.motion_a.displacement = random.vector(path);
  c.motion_b.displacement = c.motion_a.displacement + velocity;
  const Vec3d relative = c.motion_b.displacement - c.motion_a.displacement;
  c.pose_b.translation -= toi * relative;
  c.hit = true;
  c.toi = toi;
  c.normal = normal;
  c.speed = -normal.dot(relative);
  c.doubt = 64 * 0x1p-52 * (4 + path) / c.speed;
  c.what = std::string(to_string(a)) + "-" + std::string(to_string(b)) + " meet";
  return c;
}

MovingPairCase passing(ShapeKind a, ShapeKind b, ContactFeature feature, double gap, double path,
                       Draws& random) {
  MovingPairCase c = random_pair(a, b, random);
  const Vec3d normal = contact_normal(feature, c.pose_a, c.pose_b, random);
  place(c, normal, std::max(gap, 0.0));
  // If both bodies have a point, each part of the way from it to their middles is a point of both
  // when b has moved by that part of the difference of the middles.
  c.inward = middle_of(c.a, c.pose_a) - middle_of(c.b, c.pose_b);
  if (gap < 0) c.pose_b.translation += -gap * c.inward.normalized();
  const Vec3d along = path * normal.cross(random.direction()).normalized();
  c.motion_b.displacement = along;
  c.pose_b.translation -= 0.5 * along;
  c.hit = gap <= 0;
  c.gap = gap;
  c.normal = normal;
  c.toi = std::numeric_limits<double>::quiet_NaN();
  c.what = std::string(to_string(a)) + "-" + std::string(to_string(b)) + " pass at " +
           std::to_string(gap);
  return c;
}

MovingPairCase scaled(MovingPairCase c, double factor) {
  c.a = geometry::scaled_shape(c.a, factor);
  c.b = geometry::scaled_shape(c.b, factor);
  c.pose_a.translation *= factor;
  c.pose_b.translation *= factor;
  c.motion_a.displacement *= factor;
  c.motion_b.displacement *= factor;
  c.speed *= factor;
  c.gap *= factor;
  return c;
}

MovingPairCase swapped(MovingPairCase c) {
  std::swap(c.a, c.b);
  std::swap(c.pose_a, c.pose_b);
  std::swap(c.motion_a, c.motion_b);
  return c;
}

MovingPairCase drifting(MovingPairCase c, const Vec3d& displacement) {
  c.motion_a.displacement += displacement;
  c.motion_b.displacement += displacement;
  c.doubt += 8 * 0x1p-52 * displacement.norm() / std::max(c.speed, 1e-300);
  return c;
}

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
  const Vec3d way_to_b = random.direction();
  c.pose_b.translation = random.uniform(2, 4) * way_to_b;
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
