// Draws bodies at the same place, inside each other, or with faces in one plane.
#include <algorithm>
#include <array>
#include <cmath>

#include "harness/base/reproducible_math.h"
#include "harness/kinds/pair/regimes/features.h"
#include "harness/kinds/pair/regimes/regime_draws.h"

namespace touchstone::kinds {
namespace {

// Draws two shapes of unit size.
void draw_shapes(RegimeDraw& draw, files::Case& c) {
  c.shape_a = random_shape(random_kind(draw.random), {}, draw.seed, draw.random);
  c.shape_b = random_shape(random_kind(draw.random), {}, draw.seed, draw.random);
}

}  // namespace

RegimeCase draw_identical(RegimeDraw& draw) {
  RegimeCase result{{}, "identical"};
  files::Case& c = result.pair;
  c.shape_a = random_shape(random_kind(draw.random), {}, draw.seed, draw.random);
  c.shape_b = c.shape_a;
  c.pose_a = c.pose_b = random_pose(1, draw.random);
  return result;
}

RegimeCase draw_same_pose(RegimeDraw& draw) {
  RegimeCase result{{}, "pose"};
  files::Case& c = result.pair;
  draw_shapes(draw, c);
  c.pose_a = c.pose_b = random_pose(1, draw.random);
  return result;
}

RegimeCase draw_same_centre(RegimeDraw& draw) {
  RegimeCase result{{}, "centre"};
  files::Case& c = result.pair;
  draw_shapes(draw, c);
  c.pose_a = random_pose(1, draw.random);
  c.pose_b = c.pose_a;
  c.pose_b.rotation = draw.random.rotation();
  return result;
}

RegimeCase draw_contained(RegimeDraw& draw) {
  base::Random& random = draw.random;
  RegimeCase result{{}, "inside"};
  files::Case& c = result.pair;
  c.shape_a = random_shape(random_kind(random), {}, draw.seed, random);
  const double size = std::array{0.1, 0.01, 0.001}[random.below(3)];
  c.shape_b = random_shape(random_kind(random), {size, Proportions::compact, 1}, draw.seed, random);
  c.pose_a = random_pose(1, random);
  c.pose_b.rotation = random.rotation();
  // The body is at the middle, or some way off it.
  const Vec3d away = random.below(3) == 0 ? Vec3d(Vec3d::Zero()) : Vec3d(0.1 * random.in_ball());
  c.pose_b.translation = c.pose_a.translation +
                         base::times(c.pose_a.rotation, inner_point(c.shape_a)) + away -
                         base::times(c.pose_b.rotation, inner_point(c.shape_b));
  swap_at_random(c, random);
  return result;
}

RegimeCase draw_contained_touching(RegimeDraw& draw) {
  base::Random& random = draw.random;
  RegimeCase result;
  files::Case& c = result.pair;
  c.shape_a = grid_shape(random.below(2) == 0 ? ShapeKind::box : ShapeKind::hull, 32, random);
  const Vec3d outer_extents = grid_extents(c.shape_a);
  const auto least = static_cast<int>(outer_extents.minCoeff() / grid_step);
  c.shape_b = grid_shape(random_kind(random), std::max(1, least / 2), random);
  const Vec3d room = (outer_extents - grid_extents(c.shape_b)).cwiseMax(0);
  const std::uint64_t faces = 1 + random.below(3);
  for (int i = 0; i < 3; ++i) {
    c.pose_b.translation[i] = static_cast<std::uint64_t>(i) < faces
                                  ? (random.below(2) == 0 ? room[i] : -room[i])
                                  : on_grid(-room[i], room[i], random);
  }
  const Pose pose = random_pose(1, random);
  if (random.below(2) == 0) {
    // The turned pose is exact up to rounding only.
    c.pose_b.translation = pose(c.pose_b.translation);
    c.pose_a = pose;
    c.pose_b.rotation = pose.rotation;
  }
  result.detail = "inside-" + std::to_string(faces) + "-faces";
  swap_at_random(c, random);
  return result;
}

RegimeCase draw_coplanar(RegimeDraw& draw) {
  base::Random& random = draw.random;
  constexpr std::array<Amount, 7> amounts = {{{"touching", 0},
                                              {"gap-1e-3", 1e-3},
                                              {"gap-1e-9", 1e-9},
                                              {"gap-1e-12", 1e-12},
                                              {"depth-1e-3", -1e-3},
                                              {"depth-1e-9", -1e-9},
                                              {"depth-1e-12", -1e-12}}};
  const Amount& amount = amounts[random.below(amounts.size())];
  RegimeCase result{{}, "flush-" + std::string(amount.name)};
  files::Case& c = result.pair;
  const Vec3d half_a = grid_extents(grid_shape(ShapeKind::box, 32, random));
  Vec3d half_b = grid_extents(grid_shape(ShapeKind::box, 32, random));
  const bool both_faces = random.below(2) == 0;
  if (both_faces) half_b.z() = half_a.z();
  const auto shape = [&](const Vec3d& half) {
    if (random.below(2) == 0) return box_as_hull(half);
    Shape box;
    box.kind = ShapeKind::box;
    box.half_extents = half;
    return box;
  };
  c.shape_a = shape(half_a);
  c.shape_b = shape(half_b);
  // The bodies are side by side along x, with their tops in one plane; along y they are flush or
  // shifted.
  const double shift = half_a.y() + half_b.y();
  const Vec3d offset(
      half_a.x() + half_b.x() + amount.value * grade::pair_size(c),
      random.below(2) == 0 ? half_a.y() - half_b.y() : on_grid(-shift, shift, random) / 2,
      half_a.z() - half_b.z());
  c.pose_a = random_pose(1, random);
  if (random.below(2) == 0) c.pose_a.rotation = Mat3d::Identity();
  c.pose_b.rotation = c.pose_a.rotation;
  c.pose_b.translation = c.pose_a.translation + base::times(c.pose_a.rotation, offset);
  swap_at_random(c, random);
  return result;
}

}  // namespace touchstone::kinds
