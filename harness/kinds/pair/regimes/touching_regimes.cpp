// Draws pairs that touch exactly in every encoding of the input.
//
// They touch with the numbers as doubles, rounded to float, and with the rotation as a matrix or as
// a quaternion.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/signed_permutation.h"
#include "harness/kinds/pair/regimes/regime_draws.h"

namespace touchstone::kinds {
namespace {

using Points = std::vector<Vec3d>;

constexpr std::array<std::string_view, 3> touching_names = {"vertex", "edge", "face"};

int integer(int low, int high, base::Random& random) {
  return low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low) + 1));
}
Vec3d integers(int most, base::Random& random) {
  const int x = integer(-most, most, random), y = integer(-most, most, random);
  return Vec3d(x, y, integer(-most, most, random));
}

// --- one pose, and a common plane with small whole numbers --------------------------------------

// Returns a non-zero vector of whole numbers across k; every such vector can come about.
Vec3d across(const Vec3d& k, base::Random& random) {
  for (;;) {
    Vec3d v = base::outer(k, integers(6, random));
    if (!v.isZero(0)) return v;
  }
}

// Returns points of a hull that touches the plane k . x = 0 from the side where `side` * k . x > 0:
// in the plane it has a vertex at the origin, an edge along `line` or a face with the origin inside
// it.
Points touching_plane(std::size_t feature, const Vec3d& k, double side, const Vec3d& line,
                      base::Random& random) {
  Points points;
  if (feature == 0) points.push_back(Vec3d::Zero());
  if (feature == 1) {
    points.push_back(integer(1, 3, random) * line);
    points.push_back(-integer(1, 3, random) * line);
  }
  if (feature == 2) {
    Vec3d other = across(k, random);
    while (base::outer(other, line).isZero(0)) other = across(k, random);
    points.insert(points.end(), {line, other, -(line + other)});
  }
  for (int more = integer(3, 10, random); more > 0;) {
    Vec3d p = integers(96, random);
    const double height = side * base::inner(k, p);
    if (height == 0) continue;
    points.push_back(height > 0 ? p : Vec3d(Vec3d::Zero() - p));
    --more;
  }
  return points;
}

// --- the local origins are the common point -----------------------------------------------------

// Returns points of a hull that touches the plane z = 0 from above in the feature at the origin;
// all other points are at least 10 degrees off the plane. All numbers are floats.
Points above_origin(std::size_t feature, const Vec3d& line, base::Random& random) {
  Points points;
  if (feature == 0) points.push_back(Vec3d::Zero());
  if (feature == 1) {
    points.push_back(line);
    points.push_back(-std::ldexp(1, integer(-1, 1, random)) * line);
  }
  if (feature == 2) {
    Vec3d other(-line.y(), line.x(), 0);
    other += 0.25 * integer(-2, 2, random) * line;
    points.insert(points.end(), {line, other, -(line + other)});
  }
  for (int more = integer(3, 10, random); more > 0; --more) {
    const Vec3d p = integers(64, random) / 64;
    points.emplace_back(p.x(), p.y(), 0.25 + std::abs(p.z()));
  }
  return points;
}

Mat3d turn_about_z(base::Random& random) {
  const base::SinCos turn = base::sin_cos_turns(random.unit());
  Mat3d m;
  m << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
  return m;
}

// Returns a turn about the z axis, then by an angle whose sine is at most about 0.1.
Mat3d small_tilt(base::Random& random) {
  const Vec3d v = 0.05 * random.in_ball();
  return base::product(base::rotation_of({1, v.x(), v.y(), 0}), turn_about_z(random));
}

bool crossing(const Vec3d& u, const Vec3d& v) {
  return std::abs(base::outer(base::unit(u), base::unit(v)).z()) > 0.25;
}

void turn_points(Points& points, const geometry::SignedPermutation& turn) {
  for (Vec3d& p : points) p = turn(p);
}

Pose common_pose(base::Random& random) {
  Pose pose = random_pose(1, random);
  if (random.below(4) == 0) pose.translation *= 1000;
  return pose;
}

}  // namespace

RegimeCase draw_touching_baked(RegimeDraw& draw) {
  base::Random& random = draw.random;
  const std::size_t a = draw.index % 3, b = draw.index / 3 % 3;
  RegimeCase result{{}, std::string(touching_names[a]) + "-" + std::string(touching_names[b])};
  files::Case& c = result.pair;
  Vec3d k = Vec3d::Zero();
  while (k.isZero(0)) k = integers(3, random);
  const Vec3d line = across(k, random);
  const bool parallel = a == 1 && b == 1 && random.below(2) == 0;
  if (parallel) result.detail += "-parallel";
  Points points_a = touching_plane(a, k, -1, line, random);
  Points points_b = touching_plane(b, k, 1, parallel ? line : across(k, random), random);
  const Vec3d common = integers(64, random);
  for (Points* points : {&points_a, &points_b}) {
    for (Vec3d& p : *points) p = (p + common) / 128;
  }
  c.shape_a = hull_of(std::move(points_a));
  c.shape_b = hull_of(std::move(points_b));
  c.pose_a = c.pose_b = common_pose(random);
  return result;
}

RegimeCase draw_touching_origin(RegimeDraw& draw) {
  // The meetings: a face, an edge or a vertex against a vertex, two edges that cross, and a half-space
  // and a vertex.
  struct Meeting {
    std::size_t a, b;
    bool planar = false;
  };
  constexpr std::array<Meeting, 5> meetings = {{{0, 0}, {1, 0}, {2, 0}, {1, 1}, {2, 0, true}}};
  base::Random& random = draw.random;
  const Meeting& meeting = meetings[draw.index % meetings.size()];
  RegimeCase result{
      {}, std::string(touching_names[meeting.a]) + "-" + std::string(touching_names[meeting.b])};
  files::Case& c = result.pair;
  // Both bodies are above z = 0; a is then turned upside down.
  const auto line = [&] {
    Vec3d v = Vec3d::Zero();
    while (v.isZero(0)) {
      v = integers(8, random) / 8;
      v.z() = 0;
    }
    return v;
  };
  const Vec3d line_a = line();
  const Vec3d line_b = line();
  const geometry::SignedPermutation axes = geometry::signed_permutations()[random.below(24)];
  const geometry::SignedPermutation over{{0, 1, 2}, {1, -1, -1}};
  if (meeting.planar) {
    c.shape_a.kind = ShapeKind::halfspace;
    c.shape_a.normal = random.magnitude(0.1, 10) * axes(Vec3d(Vec3d::UnitZ()));
  } else {
    Points points = above_origin(meeting.a, line_a, random);
    turn_points(points, over);
    turn_points(points, axes);
    c.shape_a = hull_of(std::move(points));
  }
  c.shape_b = hull_of(above_origin(meeting.b, line_b, random));
  c.pose_a = common_pose(random);
  c.pose_b = c.pose_a;
  c.pose_b.rotation = base::product(c.pose_a.rotation, axes.matrix());
  if (meeting.a != 1 || meeting.b != 1) {
    c.pose_b.rotation = base::product(c.pose_b.rotation, small_tilt(random));
  } else {
    // The edges stay in one plane, which rounding may tilt.
    Mat3d turn = turn_about_z(random);
    while (!crossing(over(line_a), base::times(turn, line_b))) turn = turn_about_z(random);
    c.pose_b.rotation = base::product(c.pose_b.rotation, turn);
  }
  swap_at_random(c, random);
  return result;
}

RegimeCase draw_touching_grid(RegimeDraw& draw) {
  RegimeCase result;
  result.detail = touch_on_grid(result.pair, Roundness::none, 0, draw.random);
  swap_at_random(result.pair, draw.random);
  return result;
}

RegimeCase draw_touching_pythagorean(RegimeDraw& draw) {
  RegimeCase result;
  result.detail = touch_on_grid(result.pair, Roundness::balls,
                                static_cast<int>(draw.regime.parameter), draw.random);
  swap_at_random(result.pair, draw.random);
  return result;
}

RegimeCase draw_touching_curved(RegimeDraw& draw) {
  RegimeCase result;
  result.detail = touch_along_axis(result.pair, draw.random);
  swap_at_random(result.pair, draw.random);
  return result;
}

}  // namespace touchstone::kinds
