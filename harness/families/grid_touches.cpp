// Draws touches, and sweeps bodies.
#include "harness/families/grid_touches.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "algorithms/core/bounds.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::families {
namespace {

Vec3d drawn_on_grid(int reach, double step, Draws& random) {
  Vec3d v;
  for (double& x : v) x = step * (random.below(2 * reach + 1) - reach);
  return v;
}

Shape grid_shape(bool ball, Draws& random) {
  if (ball) return round_shape(ShapeKind::sphere, 0.25 * (1 + random.below(4)), 0);
  if (random.below(2) == 0) {
    constexpr std::array extents = {0.25, 0.5, 1.0, 8.0};
    Vec3d half;
    for (double& x : half) x = extents[static_cast<std::size_t>(random.below(4))];
    return box_shape(half);
  }
  std::vector<Vec3d> vertices;
  const int count = 3 + random.below(8);
  for (int i = 0; i < count; ++i) vertices.push_back(drawn_on_grid(4, 0.25, random));
  return hull_shape(std::move(vertices));
}

Vec3d grid_normal(bool along_axis, Draws& random) {
  Vec3d normal = Vec3d::Zero();
  if (along_axis) {
    normal[random.below(3)] = random.below(2) == 0 ? 1 : -1;
    return normal;
  }
  while (normal.isZero(0)) normal = drawn_on_grid(1, 1, random);
  return normal;
}

// A displacement in eighths, whose product with the normal has the sign.
Vec3d grid_path(const Vec3d& normal, int sign, Draws& random) {
  const Vec3d path = drawn_on_grid(8, 0.125, random);
  const double along = normal.dot(path), square = normal.squaredNorm();
  // Three and two divide no power of two: the normal's square times a slide stays on the grid.
  if (sign == 0) return square * path - along * normal;
  return along == 0 ? Vec3d(path + sign * normal) : Vec3d(std::copysign(1, sign * along) * path);
}

}  // namespace

MovingPairCase touching_on_grid(AfterTouch after, Draws& random) {
  MovingPairCase c;
  const bool ball = random.below(4) == 0;
  c.a = grid_shape(ball && random.below(2) == 0, random);
  c.b = grid_shape(ball, random);
  c.normal = grid_normal(ball || random.below(2) == 0, random);
  c.pose_a.translation = drawn_on_grid(8, 0.25, random);
  c.pose_b.translation =
      support_point(c.a, c.pose_a, c.normal) - support_point(c.b, Pose{}, -c.normal);
  const Vec3d aside = drawn_on_grid(2, 0.25, random);
  if (random.below(2) == 0) {
    c.pose_b.translation += c.normal.squaredNorm() * aside - c.normal.dot(aside) * c.normal;
  }
  c.motion_a.displacement = drawn_on_grid(4, 0.25, random);
  c.motion_b.displacement = c.motion_a.displacement;
  if (after != AfterTouch::rests) {
    const int sign = after == AfterTouch::slides ? 0 : after == AfterTouch::parts ? 1 : -1;
    c.motion_b.displacement += grid_path(c.normal, sign, random);
  }
  c.what = std::string(to_string(c.a.kind)) + "-" + std::string(to_string(c.b.kind)) + " touch";
  return c;
}

std::optional<PlacedShape> swept(const Shape& shape, const Pose& pose, const Vec3d& displacement) {
  if (displacement.isZero(0)) return PlacedShape{shape, pose};
  if (shape.kind == ShapeKind::sphere) {
    PlacedShape out{round_shape(ShapeKind::capsule, shape.radius, 0.5 * displacement.norm()), pose};
    out.pose.translation += 0.5 * displacement;
    out.pose.rotation = base::rotation_between(Vec3d::UnitZ(), displacement);
    return out;
  }
  std::vector<Vec3d> vertices;
  if (shape.kind == ShapeKind::box) {
    for (int k = 0; k < 8; ++k) {
      const Vec3d signs((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
      vertices.emplace_back(signs.cwiseProduct(shape.half_extents));
    }
  } else if (shape.kind == ShapeKind::hull) {
    vertices = shape.hull->vertices;
  } else {
    return {};
  }
  const Vec3d path = pose.rotation.transpose() * displacement;
  for (std::size_t k = vertices.size(); k-- > 0;) vertices.emplace_back(vertices[k] + path);
  return PlacedShape{hull_shape(std::move(vertices)), pose};
}

}  // namespace touchstone::families
