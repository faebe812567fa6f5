// Draws features that are nearly in one plane, or nearly parallel.
//
// The angle or the offset is exact: where it is small, nothing is added that would round it, so the
// bodies' axes lie along the world's.
#include <array>

#include "harness/base/reproducible_math.h"
#include "harness/geometry/signed_permutation.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/axes/axis_draws.h"
#include "harness/kinds/pair/regimes/check_shapes.h"
#include "harness/kinds/pair/regimes/features.h"
#include "harness/kinds/pair/regimes/regime_draws.h"

namespace touchstone::kinds {
namespace {

Mat3d about_x(const base::SinCos& turn) {
  Mat3d m;
  m << 1, 0, 0, 0, turn.cos, -turn.sin, 0, turn.sin, turn.cos;
  return m;
}
Mat3d about_z(const base::SinCos& turn) {
  Mat3d m;
  m << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
  return m;
}
base::SinCos radians(double angle) { return base::sin_cos_turns(angle * 0.15915494309189533577); }

// Returns the rotation of z to x, x to y and y to z.
Mat3d z_to_x() {
  Mat3d m;
  m << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return m;
}

Shape box_of(const Vec3d& half) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = half;
  return shape;
}

// --- near coplanar ------------------------------------------------------------------------------

// Places equally high boxes beside each other, the second higher by `step` (metres).
RegimeCase side_by_side(RegimeDraw& draw, bool second_as_hull) {
  base::Random& random = draw.random;
  const double step = draw.regime.parameter;
  Vec3d half_a = compact_half(1, random), half_b = compact_half(1, random);
  half_b.z() = half_a.z();
  const MildAmount amount = mild_amount(random);
  RegimeCase result{{}, "side-by-side-" + amount.name};
  files::Case& c = result.pair;
  c.shape_a = box_of(half_a);
  c.shape_b = second_as_hull ? box_as_hull(half_b) : box_of(half_b);
  const geometry::SignedPermutation turn = geometry::signed_permutations()[random.below(24)];
  const double across = (half_a.y() + half_b.y()) * random.uniform(-0.9, 0.9);
  const double along = half_a.x() + half_b.x() + amount.value;
  c.pose_a.rotation = c.pose_b.rotation = turn.matrix();
  c.pose_b.translation = turn(Vec3d(along, across, step));
  return result;
}

// Returns the middle of the cap, with the cap's normal.
Feature top_of(const Shape& prism) {
  Feature top;
  top.point = base::exactly(prism.hull->vertices.back());
  top.normal = Vec3d::UnitZ();
  return top;
}

RegimeCase on_a_cap(RegimeDraw& draw, ShapeKind kind, bool two_caps) {
  base::Random& random = draw.random;
  const double bulge = draw.regime.parameter;
  RegimeCase result;
  files::Case& c = result.pair;
  const auto prism = [&] { return capped_prism(static_cast<int>(4 + random.below(9)), bulge); };
  c.shape_a = prism();
  c.shape_b =
      two_caps ? prism() : shape_of_extents(kind, compact_half(1, random), draw.seed, random);
  c.pose_a = random_pose(1, random);
  const Feature a = top_of(c.shape_a);
  const Feature b =
      two_caps ? top_of(c.shape_b)
               : pick_feature(c.shape_b, random_feature_kind(c.shape_b, random), 0, random);
  const MildAmount amount = mild_amount(random);
  c.pose_b.rotation = facing(c.pose_a.rotation, a, b, false, random);
  place(c, a, b, amount.value, false);
  result.detail = "cap-" + std::string(to_string(b.kind)) + "-" + amount.name;
  swap_at_random(c, random);
  return result;
}

// --- near parallel ------------------------------------------------------------------------------

// A body with a feature that faces along z (first body) or against it (second body) and has its
// direction along x. The angle turns it afterwards.
struct Posed {
  Shape shape;
  Mat3d rotation;
  Feature feature;
};

constexpr double side(bool first) { return first ? 1 : -1; }

// Makes a body with an edge along x.
Posed with_edge(bool as_hull, bool first, base::Random& random) {
  const Vec3d half = compact_half(1, random);
  Posed posed;
  posed.shape = as_hull ? box_as_hull(half) : box_of(half);
  posed.rotation = about_x(base::sin_cos_turns(random.uniform(0.05, 0.2)));
  const Vec3d normal = base::transposed_times(posed.rotation, Vec3d(0, 0, side(first)));
  posed.feature = box_feature(half, base::unit({0, normal.y(), normal.z()}), random);
  return posed;
}

// Makes a capsule or cylinder with its side along x.
Posed with_side(ShapeKind kind, bool first, std::uint64_t seed, base::Random& random) {
  Posed posed;
  posed.shape = shape_of_extents(kind, compact_half(1, random), seed, random);
  posed.rotation = z_to_x();
  Feature& feature = posed.feature;
  feature.kind = FeatureKind::side;
  feature.normal = base::transposed_times(posed.rotation, Vec3d(0, 0, side(first)));
  feature.direction = Vec3d::UnitZ();
  feature.point = base::exactly({0, 0, posed.shape.half_length * random.uniform(-0.8, 0.8)});
  feature.radius = posed.shape.radius;
  return posed;
}

// Makes a body with a face across z. The second body is to be turned about x, so its feature is the
// face's lowest edge.
Posed with_face(bool as_hull, bool first, double angle, base::Random& random) {
  const Vec3d half = compact_half(1, random);
  Posed posed;
  posed.shape = as_hull ? box_as_hull(half) : box_of(half);
  posed.rotation = first ? about_z(base::sin_cos_turns(random.unit())) : Mat3d(Mat3d::Identity());
  const base::SinCos turn = radians(angle);
  const Vec3d normal = first ? Vec3d(0, 0, 1) : Vec3d(0, -turn.sin, -turn.cos);
  posed.feature = box_feature(half, normal, random);
  return posed;
}

}  // namespace

RegimeCase draw_near_coplanar(RegimeDraw& draw) {
  using enum ShapeKind;
  constexpr std::array<ShapeKind, 8> kinds = {hull, box, box, sphere, hull, box, capsule, cylinder};
  const std::uint64_t slot = slot_of(draw.index) % kinds.size();
  if (slot == 1 || slot == 5) return side_by_side(draw, slot == 5);
  return on_a_cap(draw, kinds[slot], slot == 0);
}

RegimeCase draw_near_parallel(RegimeDraw& draw) {
  using enum ShapeKind;
  base::Random& random = draw.random;
  const double angle = draw.regime.parameter;
  const std::uint64_t slot = slot_of(draw.index) % 8;
  const bool faces = slot == 1 || slot == 4 || slot == 7;
  Posed a, b;
  switch (slot) {
    case 0: a = with_edge(false, true, random), b = with_edge(false, false, random); break;
    case 2:
      a = with_side(capsule, true, draw.seed, random);
      b = with_side(capsule, false, draw.seed, random);
      break;
    case 3: a = with_edge(true, true, random), b = with_edge(true, false, random); break;
    case 5:
      a = with_side(capsule, true, draw.seed, random);
      b = with_edge(false, false, random);
      break;
    case 6:
      a = with_side(cylinder, true, draw.seed, random);
      b = with_side(cylinder, false, draw.seed, random);
      break;
    default:  // 1: boxes, 4: hulls, 7: one of each
      a = with_face(slot == 4, true, angle, random);
      b = with_face(slot != 1, false, angle, random);
      break;
  }
  const Mat3d tilt = faces ? about_x(radians(angle)) : about_z(radians(angle));
  RegimeCase result;
  files::Case& c = result.pair;
  c.shape_a = a.shape;
  c.shape_b = b.shape;
  c.pose_a.rotation = a.rotation;
  c.pose_b.rotation = base::product(tilt, b.rotation);
  if (angle >= 1e-8 && random.below(2) == 0) {
    const Mat3d turn = random.rotation();
    c.pose_a.rotation = base::product(turn, c.pose_a.rotation);
    c.pose_b.rotation = base::product(turn, c.pose_b.rotation);
  }
  const MildAmount amount = mild_amount(random);
  place(c, a.feature, b.feature, amount.value, false);
  result.detail = std::string(faces                              ? "faces"
                              : a.feature.kind == b.feature.kind ? to_string(a.feature.kind)
                                                                 : "side-edge") +
                  "-" + amount.name;
  swap_at_random(c, random);
  return result;
}

}  // namespace touchstone::kinds
