// Draws the cases of most axes.
#include "harness/kinds/pair/axes/axis_draws.h"

#include <algorithm>
#include <array>

#include "harness/grade/margins.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/regimes/check_shapes.h"
#include "harness/kinds/pair/regimes/features.h"
#include "harness/kinds/pair/regimes/regime_draws.h"

namespace touchstone::kinds {
namespace {

// Draws two compact bodies of these sizes (metres) and of the slot's kinds, the first in a random
// pose.
RegimeCase compact_pair(RegimeDraw& draw, double size_a, double size_b) {
  base::Random& random = draw.random;
  const KindPair kinds = kinds_of_slot(slot_of(draw.index));
  RegimeCase result;
  files::Case& c = result.pair;
  c.shape_a = shape_of_extents(kinds.a, compact_half(size_a, random), draw.seed, random);
  c.shape_b = shape_of_extents(kinds.b, compact_half(size_b, random), draw.seed, random);
  c.pose_a = random_pose(std::max(size_a, size_b), random);
  return result;
}

RegimeCase draw_at_signed_distance(RegimeDraw& draw, double value, const char* name) {
  RegimeCase result = compact_pair(draw, 1, 1);
  files::Case& c = result.pair;
  // `fine` is true, since otherwise the rounding of a translation would exceed the gap.
  result.detail = place_at_features(c, value * grade::pair_size(c), true, draw.random) + "-" + name;
  swap_at_random(c, draw.random);
  return result;
}

}  // namespace

RegimeCase draw_at_scale(RegimeDraw& draw) {
  const double size = draw.regime.parameter;
  RegimeCase result = compact_pair(draw, size, size);
  result.detail = place_mildly(result.pair, size, draw.random);
  swap_at_random(result.pair, draw.random);
  return result;
}

RegimeCase draw_at_aspect(RegimeDraw& draw) {
  base::Random& random = draw.random;
  const double aspect = draw.regime.parameter;
  const KindPair kinds = kinds_of_slot(slot_of(draw.index));
  RegimeCase result;
  files::Case& c = result.pair;
  c.shape_a = shape_of_extents(kinds.a, slender_half(1, aspect, random), draw.seed, random);
  c.shape_b = shape_of_extents(kinds.b, slender_half(1, aspect, random), draw.seed, random);
  c.pose_a = random_pose(1, random);
  result.detail = place_mildly(c, random.below(2) == 0 ? 1 : 1 / aspect, random);
  swap_at_random(c, random);
  return result;
}

RegimeCase draw_at_distance(RegimeDraw& draw) {
  base::Random& random = draw.random;
  RegimeCase result = compact_pair(draw, 1, 1);
  files::Case& c = result.pair;
  Vec3d way = random.on_sphere();
  if (random.below(4) == 0) way = Vec3d::UnitX();
  c.pose_a.translation = draw.regime.parameter * way;
  result.detail = place_mildly(c, 1, random);
  return result;
}

RegimeCase draw_at_ratio(RegimeDraw& draw) {
  base::Random& random = draw.random;
  const double small = 1 / draw.regime.parameter;
  const bool first = random.below(2) == 0;
  RegimeCase result = compact_pair(draw, first ? 1 : small, first ? small : 1);
  result.detail = place_mildly(result.pair, random.below(2) == 0 ? 1 : small, random);
  swap_at_random(result.pair, random);
  return result;
}

RegimeCase draw_at_gap(RegimeDraw& draw) {
  return draw_at_signed_distance(draw, draw.regime.parameter, "gap");
}

RegimeCase draw_at_depth(RegimeDraw& draw) {
  return draw_at_signed_distance(draw, -draw.regime.parameter, "depth");
}

RegimeCase draw_with_vertices(RegimeDraw& draw) {
  using enum ShapeKind;
  constexpr std::array<ShapeKind, 6> others = {hull, box, sphere, hull, capsule, cylinder};
  base::Random& random = draw.random;
  const auto count = static_cast<std::size_t>(draw.regime.parameter);
  const std::uint64_t slot = slot_of(draw.index);
  const auto ringed = [&] {
    Shape shape;
    shape.kind = hull;
    shape.hull = ringed_hull(count, compact_half(1, random));
    return shape;
  };
  RegimeCase result;
  files::Case& c = result.pair;
  c.shape_a = ringed();
  const ShapeKind kind = others[slot % others.size()];
  if (slot % others.size() == 0) {
    c.shape_b = c.shape_a;
  } else {
    c.shape_b = shape_of_extents(kind, compact_half(1, random), draw.seed, random);
  }
  c.pose_a = random_pose(1, random);
  result.detail = place_mildly(c, 1, random);
  swap_at_random(c, random);
  return result;
}

KindPair kinds_of_slot(std::uint64_t slot) {
  using enum ShapeKind;
  constexpr std::array<KindPair, 16> pairs = {{{box, box},
                                               {hull, hull},
                                               {sphere, box},
                                               {capsule, capsule},
                                               {box, hull},
                                               {ellipsoid, ellipsoid},
                                               {capsule, hull},
                                               {cylinder, box},
                                               {sphere, hull},
                                               {cone, hull},
                                               {capsule, box},
                                               {box, halfspace},
                                               {box, box},
                                               {hull, hull},
                                               {sphere, capsule},
                                               {cylinder, ellipsoid}}};
  return pairs[slot % pairs.size()];
}

MildAmount mild_amount(base::Random& random) {
  constexpr std::array<const char*, 3> names = {"1e-1", "1e-2", "1e-3"};
  constexpr std::array<double, 3> values = {1e-1, 1e-2, 1e-3};
  const std::uint64_t k = random.below(3);
  if (random.below(2) == 0) return {std::string("gap-") + names[k], values[k]};
  return {std::string("depth-") + names[k], -values[k]};
}

std::string place_at_features(files::Case& c, double gap, bool fine, base::Random& random) {
  const FeatureKind kind_a = random_feature_kind(c.shape_a, random);
  const FeatureKind kind_b = random_feature_kind(c.shape_b, random);
  const Feature a = pick_feature(c.shape_a, kind_a, grade::shape_size(c.shape_b) / 2, random);
  const Feature b = pick_feature(c.shape_b, kind_b, grade::shape_size(c.shape_a) / 2, random);
  c.pose_b.rotation = facing(c.pose_a.rotation, a, b, false, random);
  place(c, a, b, gap, fine);
  return std::string(to_string(a.kind)) + "-" + std::string(to_string(b.kind));
}

std::string place_mildly(files::Case& c, double length, base::Random& random) {
  if (random.below(8) == 0) {
    c.pose_b.rotation = random.rotation();
    place_at_random(c, random);
    return "random";
  }
  const MildAmount amount = mild_amount(random);
  return place_at_features(c, amount.value * length, false, random) + "-" + amount.name;
}

}  // namespace touchstone::kinds
