// Draws gaps and depths between chosen features, at unit scale and at the extremes.
#include <array>
#include <cmath>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/signed_permutation.h"
#include "harness/kinds/pair/regimes/features.h"
#include "harness/kinds/pair/regimes/regime_draws.h"

namespace touchstone::kinds {
namespace {

// Alignment of the two features, beyond their opposite normals. `parallel`: the directions of two
// lines are parallel up to rounding. `exact`: parallel faces or edges are exactly so, because the
// bodies share one rotation matrix, up to the order and sign of its columns.
enum class Alignment : std::uint8_t { free, parallel, exact };

struct ContactPlan {
  FeatureKind a, b;
  Alignment alignment;
  std::uint64_t weight;
};

using enum FeatureKind;
using enum Alignment;

constexpr ContactPlan plans[] = {
    {face, face, free, 4},     {face, face, exact, 2},    {edge, edge, free, 4},
    {edge, edge, parallel, 2}, {edge, edge, exact, 2},    {edge, face, free, 3},
    {edge, face, exact, 2},    {vertex, face, free, 4},   {vertex, edge, free, 3},
    {vertex, vertex, free, 3}, {smooth, smooth, free, 4}, {smooth, face, free, 3},
    {smooth, edge, free, 3},   {smooth, vertex, free, 3}, {side, side, free, 2},
    {side, side, parallel, 1}, {side, face, free, 2},     {side, edge, free, 2},
    {side, edge, parallel, 1}, {side, vertex, free, 2},   {side, smooth, free, 2},
    {rim, face, free, 1},      {rim, edge, free, 1},      {rim, vertex, free, 1},
    {rim, smooth, free, 1},    {rim, side, free, 1},      {rim, rim, free, 1},
    {tip, face, free, 1},      {tip, edge, free, 1},      {tip, vertex, free, 1},
    {tip, smooth, free, 1},    {tip, side, free, 1},      {tip, rim, free, 1},
    {tip, tip, free, 1},       {base, face, free, 1},     {base, edge, free, 1},
    {base, vertex, free, 1},   {base, smooth, free, 1},   {base, side, free, 1},
    {base, rim, free, 1},      {base, tip, free, 1},      {base, base, free, 1},
};

// Selects each plan as often as its weight says within a round of indices, never the same twice in
// a row.
const ContactPlan& plan_of(std::uint64_t index) {
  constexpr std::uint64_t stride = 31;  // a prime that does not divide the number of places
  constexpr std::uint64_t places = [] {
    std::uint64_t sum = 0;
    for (const ContactPlan& plan : plans) sum += plan.weight;
    return sum;
  }();
  static_assert(places % stride != 0);
  std::uint64_t place = index % places * stride % places;
  const ContactPlan* plan = plans;
  for (; place >= plan->weight; ++plan) place -= plan->weight;
  return *plan;
}

std::string name_of(const ContactPlan& plan) {
  std::string name = std::string(to_string(plan.a)) + "-" + std::string(to_string(plan.b));
  if (plan.alignment == parallel) name += "-parallel";
  if (plan.alignment == exact) name += "-exact";
  return name;
}

ShapeKind kind_with(FeatureKind feature, bool bounded, base::Random& random) {
  switch (feature) {
    case face:
      if (!bounded && random.below(10) == 0) return ShapeKind::halfspace;
      [[fallthrough]];
    case vertex:
    case edge: return random.below(2) == 0 ? ShapeKind::box : ShapeKind::hull;
    case smooth:
      return std::array{ShapeKind::sphere, ShapeKind::sphere, ShapeKind::capsule,
                        ShapeKind::ellipsoid}[random.below(4)];
    case side:
      return std::array{ShapeKind::capsule, ShapeKind::capsule, ShapeKind::cylinder,
                        ShapeKind::cone}[random.below(4)];
    case rim:
    case base: return random.below(2) == 0 ? ShapeKind::cylinder : ShapeKind::cone;
    case tip: break;
  }
  return ShapeKind::cone;
}

// The shapes, gap and place of a contact.
struct ContactSetting {
  ShapeStyle style_a, style_b;
  double gap = 0;        // part of the pair's size; < 0: a depth
  double distance = -1;  // distance of a from the origin, metres; < 0: about the bodies' size
};

void finish(const ContactSetting& setting, const Feature& a, const Feature& b, files::Case& c,
            base::Random& random) {
  const bool fine = setting.distance < 0 && random.below(4) == 0;
  place(c, a, b, setting.gap * grade::pair_size(c), fine);
}

// Returns half the size of the other body; the body itself may be a half-space, of size 0.
double reach_of(const Shape& other) { return grade::shape_size(other) / 2; }

Pose first_pose(const ContactSetting& setting, double size, base::Random& random) {
  Pose pose = random_pose(size, random);
  if (setting.distance >= 0) {
    pose.translation = setting.distance * random.on_sphere();
    if (random.below(4) == 0) pose.translation = {setting.distance, 0, 0};
  }
  return pose;
}

// Places two boxes with parallel axes so that features of the kind face each other.
void place_axis_parallel_boxes(FeatureKind kind, const ContactSetting& setting, files::Case& c,
                               base::Random& random) {
  const Feature a = pick_feature(c.shape_a, kind, 0, random);
  const geometry::SignedPermutation turn = geometry::signed_permutations()[random.below(24)];
  c.pose_b.rotation = base::product(c.pose_a.rotation, turn.matrix());
  const Vec3d normal = Vec3d::Zero() - turn.inverse()(a.normal);
  finish(setting, a, box_feature(c.shape_b.half_extents, normal, random), c, random);
}

// Places a hull and its point reflection: each feature is parallel to its image.
void place_mirrored_hulls(FeatureKind kind, const ContactSetting& setting, files::Case& c,
                          base::Random& random) {
  c.shape_b = mirrored(c.shape_a);
  c.pose_b.rotation = c.pose_a.rotation;
  const Feature a = pick_feature(c.shape_a, kind, 0, random);
  Feature b = a;
  b.point = base::exactly(Vec3d::Zero()) - a.point;
  b.normal = Vec3d::Zero() - a.normal;
  finish(setting, a, b, c, random);
}

// Places a box's edge along z on a face of a square prism with face normals (+-1, +-1, 0).
void place_edge_on_diamond(const ContactSetting& setting, std::uint64_t seed, files::Case& c,
                           base::Random& random) {
  c.shape_a = random_shape(ShapeKind::box, setting.style_a, seed, random);
  const Vec3d sides = random_shape(ShapeKind::box, setting.style_b, seed, random).half_extents;
  const double s = sides.x(), t = sides.z();
  std::vector<Vec3d> corners;
  for (const double z : {-t, t}) {
    corners.insert(corners.end(), {{s, 0, z}, {0, s, z}, {-s, 0, z}, {0, -s, z}});
  }
  c.shape_b = hull_of(std::move(corners));
  c.pose_a = first_pose(setting, grade::pair_size(c), random);
  c.pose_b.rotation = c.pose_a.rotation;
  const double sign_x = random.below(2) == 0 ? 1 : -1;
  const Vec3d signs(sign_x, random.below(2) == 0 ? 1 : -1, 0);
  const Feature a = box_feature(c.shape_a.half_extents, base::unit(signs), random);
  // The point lies exactly between two of the corners, (-x s, 0) and (0, -y s).
  Feature b;
  b.kind = face;
  b.normal = Vec3d::Zero() - a.normal;
  const DoubleDouble share = DoubleDouble::product(s, random.uniform(0.1, 0.9));
  const DoubleDouble rest = DoubleDouble{s, 0} - share;
  b.point = {signs.x() > 0 ? -share : share,
             signs.y() > 0 ? -rest : rest,
             {random.uniform(-0.9, 0.9) * t, 0}};
  finish(setting, a, b, c, random);
}

void place_exactly_parallel(const ContactPlan& plan, const ContactSetting& setting,
                            std::uint64_t seed, files::Case& c, base::Random& random) {
  if (plan.a != plan.b) return place_edge_on_diamond(setting, seed, c, random);
  // A reflection has the size of its original, so the styles must be equal.
  const bool boxes = random.below(2) == 0 || !(setting.style_a == setting.style_b);
  const ShapeKind kind = boxes ? ShapeKind::box : ShapeKind::hull;
  c.shape_a = random_shape(kind, setting.style_a, seed, random);
  c.shape_b = random_shape(kind, setting.style_b, seed, random);
  c.pose_a = first_pose(setting, grade::pair_size(c), random);
  if (random.below(2) == 0) c.pose_a.rotation = Mat3d::Identity();
  if (boxes) {
    place_axis_parallel_boxes(plan.a, setting, c, random);
  } else {
    place_mirrored_hulls(plan.a, setting, c, random);
  }
}

RegimeCase make_contact(RegimeDraw& draw, const ContactSetting& setting) {
  base::Random& random = draw.random;
  const ContactPlan& plan = plan_of(draw.index);
  RegimeCase result{{}, name_of(plan)};
  files::Case& c = result.pair;
  if (plan.alignment == exact) {
    place_exactly_parallel(plan, setting, draw.seed, c, random);
  } else {
    c.shape_a = random_shape(kind_with(plan.a, false, random), setting.style_a, draw.seed, random);
    const bool bounded = c.shape_a.kind == ShapeKind::halfspace;
    c.shape_b =
        random_shape(kind_with(plan.b, bounded, random), setting.style_b, draw.seed, random);
    const Feature a = pick_feature(c.shape_a, plan.a, reach_of(c.shape_b), random);
    const Feature b = pick_feature(c.shape_b, plan.b, reach_of(c.shape_a), random);
    c.pose_a = first_pose(setting, grade::pair_size(c), random);
    c.pose_b.rotation = facing(c.pose_a.rotation, a, b, plan.alignment == parallel, random);
    finish(setting, a, b, c, random);
  }
  swap_at_random(c, random);
  return result;
}

// Makes one of several gaps and depths, or a random pose of shapes of any kind.
RegimeCase make_at_an_amount(RegimeDraw& draw, ContactSetting setting) {
  base::Random& random = draw.random;
  const Amount amount = random_amount(random);
  if (!amount.random_pose) {
    setting.gap = amount.value;
    RegimeCase result = make_contact(draw, setting);
    result.detail += '-';
    result.detail += amount.name;
    return result;
  }
  RegimeCase result{{}, std::string(amount.name)};
  files::Case& c = result.pair;
  c.shape_a = random_shape(random_kind(random), setting.style_a, draw.seed, random);
  c.shape_b = random_shape(random_kind(random), setting.style_b, draw.seed, random);
  c.pose_a = first_pose(setting, grade::pair_size(c), random);
  c.pose_b.rotation = random.rotation();
  place_at_random(c, random);
  swap_at_random(c, random);
  return result;
}

}  // namespace

RegimeCase draw_contact(RegimeDraw& draw) {
  ContactSetting setting;
  setting.gap = draw.regime.parameter;
  return make_contact(draw, setting);
}

RegimeCase draw_aspect(RegimeDraw& draw) {
  const auto style = [&] {
    return ShapeStyle{1, draw.random.below(2) == 0 ? Proportions::needle : Proportions::plate,
                      draw.regime.parameter};
  };
  ContactSetting setting;
  setting.style_a = style();
  if (draw.random.below(2) == 0) setting.style_b = style();
  return make_at_an_amount(draw, setting);
}

RegimeCase draw_scale(RegimeDraw& draw) {
  ContactSetting setting;
  setting.style_a.size = setting.style_b.size = draw.regime.parameter;
  return make_at_an_amount(draw, setting);
}

RegimeCase draw_far(RegimeDraw& draw) {
  ContactSetting setting;
  setting.distance = draw.regime.parameter;
  return make_at_an_amount(draw, setting);
}

RegimeCase draw_ratio(RegimeDraw& draw) {
  ContactSetting setting;
  double& size = draw.random.below(2) == 0 ? setting.style_a.size : setting.style_b.size;
  size = draw.random.below(2) == 0 ? draw.regime.parameter : 1 / draw.regime.parameter;
  return make_at_an_amount(draw, setting);
}

}  // namespace touchstone::kinds
