// Draws plain random poses.
#include "harness/check/regimes/placement.h"
#include "harness/check/regimes/regime_draws.h"

namespace touchstone::check {
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

}  // namespace touchstone::check
