// Builds bodies on a grid and makes them touch exactly.
#include "harness/kinds/pair/regimes/regime_draws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "harness/base/reproducible_math.h"
#include "harness/geometry/signed_permutation.h"
#include "harness/grade/margins.h"
#include "harness/kinds/pair/regimes/check_shapes.h"

namespace touchstone::kinds {
namespace {

struct Pythagorean {
  std::array<int, 3> side;
  int diagonal;
};
constexpr std::array<Pythagorean, 12> wholes = {{{{1, 0, 0}, 1},
                                                 {{2, 0, 0}, 2},
                                                 {{3, 4, 0}, 5},
                                                 {{5, 12, 0}, 13},
                                                 {{8, 15, 0}, 17},
                                                 {{20, 21, 0}, 29},
                                                 {{1, 2, 2}, 3},
                                                 {{2, 3, 6}, 7},
                                                 {{1, 4, 8}, 9},
                                                 {{4, 4, 7}, 9},
                                                 {{2, 6, 9}, 11},
                                                 {{6, 6, 7}, 11}}};

double sign(base::Random& random) { return random.below(2) == 0 ? 1 : -1; }

geometry::SignedPermutation random_turn(base::Random& random) {
  return geometry::signed_permutations()[random.below(geometry::signed_permutations().size())];
}

ShapeKind polytope_kind(base::Random& random) {
  return random.below(2) == 0 ? ShapeKind::box : ShapeKind::hull;
}

bool is_ball(ShapeKind kind) { return kind == ShapeKind::sphere || kind == ShapeKind::capsule; }

// Returns the extents of the shape without its ball.
Vec3d core_extents(const Shape& shape) {
  if (!is_ball(shape.kind)) return grid_extents(shape);
  return {0, 0, shape.kind == ShapeKind::capsule ? shape.half_length : 0};
}

Vec3d random_place(base::Random& random) {
  Vec3d place;
  for (int i = 0; i < 3; ++i) place[i] = on_grid(-2, 2, random);
  return place;
}

// Turns both bodies and moves them away from the origin, exactly.
void move_both(files::Case& c, base::Random& random) {
  const geometry::SignedPermutation turn = random_turn(random);
  const Vec3d place = random_place(random);
  for (Pose* pose : {&c.pose_a, &c.pose_b}) {
    pose->rotation = turn(pose->rotation);
    pose->translation = turn(pose->translation) + place;
  }
}

// Makes a half-space, and a shape whose core is as far from its plane as the shape's radius.
std::string touch_plane(files::Case& c, ShapeKind kind, base::Random& random) {
  c.shape_a.kind = ShapeKind::halfspace;
  c.shape_a.normal = {0, 0, std::ldexp(1.0, static_cast<int>(random.below(5)) - 2)};
  c.shape_b = grid_shape(kind, 32, random);
  const geometry::SignedPermutation turn = random_turn(random);
  c.pose_b.rotation = turn.matrix();
  const double height = turn(grid_extents(c.shape_b)).cwiseAbs().z();
  const double offset = on_grid(-1, 1, random);
  c.shape_a.offset = offset * c.shape_a.normal.z();
  c.pose_b.translation = {on_grid(-1, 1, random), on_grid(-1, 1, random), offset + height};
  move_both(c, random);
  return "plane";
}

void give_radii(files::Case& c, double sum, int ulps, base::Random& random) {
  const bool a_is_ball = is_ball(c.shape_a.kind), b_is_ball = is_ball(c.shape_b.kind);
  if (a_is_ball) c.shape_a.radius = b_is_ball ? on_grid(0, sum, random) : sum;
  if (b_is_ball) c.shape_b.radius = a_is_ball ? sum - c.shape_a.radius : sum;
  double& last = b_is_ball ? c.shape_b.radius : c.shape_a.radius;
  double& other = a_is_ball ? c.shape_a.radius : c.shape_b.radius;
  double& changed = last > 0 ? last : other;
  const double towards = ulps > 0 ? 0 : std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) changed = std::nextafter(changed, towards);
}

// Returns the point of a grid shape furthest along a signed axis, or one of several such points.
Vec3d furthest(const Shape& shape, const Vec3d& axis, base::Random& random) {
  const Vec3d extents = grid_extents(shape);
  const bool across = axis.z() == 0;
  Vec3d p = extents.cwiseProduct(axis);
  const auto spread = [&](int i, double most) {
    if (axis[i] == 0) p[i] = on_grid(-most, most, random);
  };
  switch (shape.kind) {
    case ShapeKind::box:
    case ShapeKind::hull:
      for (int i = 0; i < 3; ++i) spread(i, extents[i]);
      break;
    case ShapeKind::capsule: spread(2, shape.half_length); break;
    case ShapeKind::cylinder:
    case ShapeKind::cone: {
      const bool tip = shape.kind == ShapeKind::cone && axis.z() > 0;
      const double most = tip ? 0 : std::floor(0.7 * shape.radius / grid_step) * grid_step;
      if (!across) {
        spread(0, most);
        spread(1, most);
      } else if (shape.kind == ShapeKind::cone) {
        p.z() = -shape.half_length;
      } else {
        spread(2, shape.half_length);
      }
      break;
    }
    default: break;
  }
  return p;
}

}  // namespace

double on_grid(double low, double high, base::Random& random) {
  const auto steps = static_cast<std::uint64_t>((high - low) / grid_step);
  return low + static_cast<double>(random.below(steps + 1)) * grid_step;
}

Shape grid_shape(ShapeKind kind, int most, base::Random& random) {
  const auto size = [&] { return on_grid(grid_step, most * grid_step, random); };
  const double x = size(), y = size();
  const Vec3d half(x, y, size());
  if (kind == ShapeKind::hull) return box_as_hull(half);
  Shape shape;
  shape.kind = kind;
  shape.radius = half.x();
  shape.half_length = half.z();
  shape.half_extents = shape.radii = half;
  return shape;
}

Vec3d grid_extents(const Shape& shape) {
  const double r = shape.radius, h = shape.half_length;
  switch (shape.kind) {
    case ShapeKind::sphere: return {r, r, r};
    case ShapeKind::capsule: return {r, r, h + r};
    case ShapeKind::box: return shape.half_extents;
    case ShapeKind::ellipsoid: return shape.radii;
    case ShapeKind::hull: {
      Vec3d extents = Vec3d::Zero();
      for (const Vec3d& v : shape.hull->vertices) extents = extents.cwiseMax(v.cwiseAbs());
      return extents;
    }
    default: return {r, r, h};
  }
}

std::string touch_on_grid(files::Case& c, Roundness roundness, int ulps, base::Random& random) {
  const bool balls = roundness == Roundness::balls;
  const auto ball_kind = [&] {
    return random.below(2) == 0 ? ShapeKind::sphere : ShapeKind::capsule;
  };
  if (ulps == 0 && random.below(8) == 0) {
    return touch_plane(c, balls ? ball_kind() : polytope_kind(random), random);
  }
  const ShapeKind kind_a = balls ? ball_kind() : polytope_kind(random);
  const ShapeKind kind_b = balls && random.below(2) == 0 ? ball_kind() : polytope_kind(random);
  c.shape_a = grid_shape(kind_a, 32, random);
  c.shape_b = grid_shape(kind_b, 32, random);

  // `side` is the offset of the two cores' closest points; `apart` marks the axes along which the
  // cores do not overlap.
  Vec3d side = Vec3d::Zero(), apart;
  double diagonal = 0;
  if (balls) {
    const Pythagorean& whole = wholes[random.below(wholes.size())];
    const double step = grid_step * static_cast<double>(1 + random.below(2));
    side = step * Vec3d(whole.side[0], whole.side[1], whole.side[2]);
    diagonal = step * whole.diagonal;
    apart = side.cwiseSign();
  } else {
    const std::uint64_t axes = 1 + random.below(3);
    apart = Vec3d(1, axes > 1 ? 1 : 0, axes > 2 ? 1 : 0);
  }
  const auto touching_axes = static_cast<std::size_t>(apart.sum());
  const geometry::SignedPermutation turn = random_turn(random), turn_a = random_turn(random),
                                    turn_b = random_turn(random);
  side = turn(side);
  apart = turn(apart);
  const Vec3d extents_a = turn_a(core_extents(c.shape_a)).cwiseAbs();
  const Vec3d extents_b = turn_b(core_extents(c.shape_b)).cwiseAbs();
  Vec3d offset;
  for (int i = 0; i < 3; ++i) {
    const double reach = extents_a[i] + extents_b[i];
    offset[i] = apart[i] == 0 ? on_grid(-reach, reach, random) : apart[i] * reach + side[i];
  }
  c.pose_a.rotation = turn_a.matrix();
  c.pose_b.rotation = turn_b.matrix();
  c.pose_b.translation = offset;
  if (balls) give_radii(c, diagonal, ulps, random);
  move_both(c, random);
  constexpr std::array<std::string_view, 3> shared = {"face", "edge", "vertex"};
  constexpr std::array<std::string_view, 3> offsets = {"axis", "triple", "quadruple"};
  return std::string((balls ? offsets : shared)[touching_axes - 1]);
}

std::string touch_along_axis(files::Case& c, base::Random& random) {
  constexpr std::array<ShapeKind, 3> curved = {ShapeKind::cylinder, ShapeKind::cone,
                                               ShapeKind::ellipsoid};
  c.shape_a = grid_shape(curved[random.below(curved.size())], 32, random);
  c.shape_b = grid_shape(random_kind(random), 32, random);
  Vec3d axis = Vec3d::Zero();
  axis[static_cast<int>(random.below(3))] = sign(random);
  const geometry::SignedPermutation turn = random_turn(random);
  const Vec3d opposite = turn.inverse()(Vec3d(Vec3d::Zero() - axis));
  c.pose_b.rotation = turn.matrix();
  const Vec3d point_a = furthest(c.shape_a, axis, random);
  c.pose_b.translation = point_a - turn(furthest(c.shape_b, opposite, random));
  move_both(c, random);
  return "axis";
}

}  // namespace touchstone::kinds
