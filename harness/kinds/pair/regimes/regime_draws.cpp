// Poses and names that several groups of regimes use, and plain random poses.
#include "harness/kinds/pair/regimes/regime_draws.h"

#include <array>
#include <utility>

#include "harness/kinds/pair/regimes/features.h"

namespace touchstone::kinds {

Pose random_pose(double size, base::Random& random) {
  Pose pose;
  if (random.below(8) != 0) pose.rotation = random.rotation();
  if (random.below(4) != 0) pose.translation = size * random.in_ball();
  return pose;
}

void swap_at_random(files::Case& c, base::Random& random) {
  if (random.below(2) == 0) return;
  std::swap(c.shape_a, c.shape_b);
  std::swap(c.pose_a, c.pose_b);
}

std::string kinds_of(const files::Case& c) {
  return std::string(to_string(c.shape_a.kind)) + "-" + std::string(to_string(c.shape_b.kind));
}

Amount random_amount(base::Random& random) {
  constexpr std::array<Amount, 7> amounts = {{{"gap-1e-3", 1e-3},
                                              {"gap-1e-6", 1e-6},
                                              {"gap-1e-9", 1e-9},
                                              {"depth-1e-3", -1e-3},
                                              {"depth-1e-6", -1e-6},
                                              {"depth-1e-9", -1e-9},
                                              {"random", 0, true}}};
  return amounts[random.below(amounts.size())];
}

std::string place_by_amount(files::Case& c, const Amount& amount, base::Random& random) {
  double size = grade::pair_size(c);
  if (size == 0) size = 1;  // two points have size 0
  c.pose_a = random_pose(size, random);
  c.pose_b.rotation = random.rotation();
  if (amount.random_pose) {
    place_at_random(c, random);
    return std::string(amount.name);
  }
  const Feature a = pick_feature(c.shape_a, random_feature_kind(c.shape_a, random),
                                 grade::shape_size(c.shape_b) / 2, random);
  const Feature b = pick_feature(c.shape_b, random_feature_kind(c.shape_b, random),
                                 grade::shape_size(c.shape_a) / 2, random);
  c.pose_b.rotation = facing(c.pose_a.rotation, a, b, false, random);
  place(c, a, b, amount.value * size, random.below(4) == 0);
  return std::string(to_string(a.kind)) + "-" + std::string(to_string(b.kind)) + "-" +
         std::string(amount.name);
}

namespace {

RegimeCase random_pair(RegimeDraw& draw, ShapeKind a, ShapeKind b) {
  RegimeCase result{{}, "random"};
  files::Case& c = result.pair;
  c.shape_a = random_shape(a, {}, draw.seed, draw.random);
  c.shape_b = random_shape(b, {}, draw.seed, draw.random);
  c.pose_a = random_pose(grade::pair_size(c), draw.random);
  c.pose_b.rotation = draw.random.rotation();
  place_at_random(c, draw.random);
  swap_at_random(c, draw.random);
  return result;
}

}  // namespace

RegimeCase draw_random_polytopes(RegimeDraw& draw) {
  const auto kind = [&] { return draw.random.below(2) == 0 ? ShapeKind::box : ShapeKind::hull; };
  const ShapeKind a = kind();
  return random_pair(draw, a, kind());
}

RegimeCase draw_random_mixed(RegimeDraw& draw) {
  const ShapeKind a = draw.random.below(12) == 0 ? ShapeKind::halfspace : random_kind(draw.random);
  return random_pair(draw, a, random_kind(draw.random));
}

}  // namespace touchstone::kinds
